// Which cuts would bring a piece of the stock loose.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/index_table.hpp"
#include "core/material/voxel_grid.hpp"
#include "core/trajectory/milling/swept_set.hpp"

namespace sculpt {

/// The stock is clamped from below: what a face-connected path of standing voxels joins to layer k = 0 is held. Not
/// shared between threads.
class PieceWatch {
 public:
  explicit PieceWatch(const VoxelGrid& voxels);

  /// Does a piece of more than `chip_voxels` hang on nothing now that `taken`, one cut, does not stand any more? What
  /// hung on nothing before, or can never be held, does not count. Exact, as long as no cut before did. All voxels
  /// beside the cut are followed at once until they are joined to each other or to the table: what that takes grows
  /// with what is cut, and with the way around it.
  bool frees(const VoxelSet& standing, const SweptSet::Taken& taken, double chip_voxels);

 private:
  using Front = std::uint32_t;
  struct Spread {
    Front parent;               ///< itself, if it is no part of another one
    std::uint32_t waiting = 0;  ///< voxels that are not followed yet
    std::uint64_t counted = 0;  ///< voxels that may not fall
  };
  struct Step {
    std::uint32_t voxel;
    Front front;
  };

  bool is_on_table(std::size_t voxel) const {
    return voxel < static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_);
  }
  Front begin_spread();
  Front root(Front front);
  void join(Front a, Front b);
  void reach(std::uint32_t voxel, Front front);
  /// Calls `visit` with the index of each standing voxel beside one.
  template <class Visit>
  void for_each_beside(const VoxelSet& standing, std::size_t voxel, const Visit& visit) const;

  int n_;
  VoxelSet may_fall_;
  IndexTable<Front> fronts_;
  std::vector<Spread> spreads_;
  std::vector<Step> now_, next_;
  std::optional<Front> table_;  ///< the spread that is joined to it
  std::size_t open_ = 0;        ///< spreads that may still grow, and that of the table
};

}  // namespace sculpt
