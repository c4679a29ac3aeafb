// Is a neighbour of a voxel that goes still joined to the table? Internal to support.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/index_table.hpp"
#include "core/material/voxel_set.hpp"

namespace sculpt {

/// From the neighbour to all that it is joined to, the lowest first, as that is where the table is. Cubes of 8^3 voxels
/// that all stand are passed in one step, so that the inside of a sculpture costs next to nothing. Refers to what it is
/// made from.
class SupportSearch {
  struct Node {
    Voxel corner;
    bool whole;  ///< a cube of voxels that all stand
    bool operator<(const Node& other) const { return corner.k > other.corner.k; }
  };

 public:
  /// Memory that one search after the other may use.
  struct Scratch {
    IndexTable<std::uint8_t> whole, seen, seen_cubes;
    std::vector<Node> open;  ///< a heap
  };

  /// `rooted(i, j)`: how many voxels stand in that column from the table up without a gap.
  SupportSearch(const VoxelSet& standing, const VoxelSet& may_fall, const std::function<int(int, int)>& rooted,
                Voxel gone, Scratch& scratch);

  enum class Way {
    held,   ///< joined to the table, or to all of the others of which none is known to be
    none,   ///< joined to nothing that holds it
    falls,  ///< the same, and all of it may fall
    long_   ///< too much to look at
  };
  /// Takes those of the `others` (neighbours of what goes, too) that it comes by out of them. `any_held`: one that is
  /// not among them is joined to the table.
  Way follow(Voxel from, std::vector<Voxel>& others, bool any_held);

 private:
  enum class Found { nothing, held };

  Found consider(Voxel voxel);
  Found enter_cube(Voxel corner);
  Found look_around(const Node& node);
  bool is_rooted(Voxel voxel) const;
  bool is_whole(Voxel corner);
  bool has_all(const VoxelSet& set, Voxel corner) const;
  Voxel cube_of(Voxel voxel) const {
    return {voxel.i / edge_ * edge_, voxel.j / edge_ * edge_, voxel.k / edge_ * edge_};
  }
  void open(const Node& node);
  bool joins_all() const { return others_->empty() && !any_held_; }

  const VoxelSet& standing_;
  const VoxelSet& may_fall_;
  const std::function<int(int, int)>& rooted_;
  Voxel gone_;
  int edge_;  ///< of a cube
  std::size_t max_looked_at_;
  Scratch& scratch_;
  std::vector<Voxel>* others_ = nullptr;
  bool any_held_ = false, foreseen_ = false;
};

}  // namespace sculpt
