// Which voxels a cutter sweeps, by the definition in docs/trajectory.md. Internal to verify/. Quanta of 1e-7 m.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/cell/milling/mill_tool.hpp"
#include "core/material/voxel_set.hpp"
#include "core/verify/mill/near_voxels.hpp"

namespace sculpt {

/// A cutter in one direction, smaller by a margin on all sides.
class CutterSweep {
 public:
  CutterSweep(const Cutter& cutter, const std::array<int, 3>& direction, double less_m);

  /// Takes out of `set` the voxels whose centres are swept on the way from one tip to the other; how many there were.
  std::uint64_t take(VoxelSet& set, const Grid& grid, const Quanta3& from, const Quanta3& to,
                     std::vector<Voxel>* taken = nullptr) const;

 private:
  struct Rod {
    std::int64_t radius, bottom;  ///< bottom: above the base, times the length of the direction
  };
  bool holds(const Quanta3& from_base, const Quanta3& way) const;

  Quanta3 direction_, base_;
  std::int64_t length2_ = 0, ball_ = 0, top_ = 0, reach_ = 0, height_ = 0;
  std::vector<Rod> rods_;
};

}  // namespace sculpt
