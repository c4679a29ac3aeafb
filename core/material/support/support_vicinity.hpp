// The 8 x 8 x 8 voxels about one that goes: which of its neighbours are joined within them, and which to the table.
// Internal to support.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/material/voxel_set.hpp"

namespace sculpt {

/// Answers most of what SupportSearch is asked, in a fraction of its time: a layer is a word of 8 x 8 bits, and what is
/// joined grows by shifts of words.
class SupportVicinity {
 public:
  /// `rooted(i, j)`: how many voxels stand in that column from the table up without a gap. Needs n >= 8.
  SupportVicinity(const VoxelSet& standing, const std::function<int(int, int)>& rooted, Voxel gone);

  /// Takes out of `left` (face neighbours of what goes) all that are joined to the table or to another one of them
  /// here, and puts those last whose piece ends here; true if any is joined to the table.
  bool settle(std::vector<Voxel>& left) const;

 private:
  using Layers = std::array<std::uint64_t, 8>;

  Layers joined_to(Voxel voxel) const;
  /// May it be joined to more outside?
  bool goes_on(const Layers& joined) const;
  static bool holds(const Layers& layers, Voxel in) {
    return (layers[static_cast<std::size_t>(in.k)] >> (in.i + 8 * in.j) & 1) != 0;
  }

  int n_;
  Voxel corner_;
  Layers standing_{}, rooted_{};
};

}  // namespace sculpt
