// Pieces of the material that milling tools cut off whole, and which are no chips. Internal to verify/.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/cell/milling/mill_tool.hpp"
#include "core/material/voxel_set.hpp"

namespace sculpt {

struct FreedChunk {
  std::uint64_t line;    ///< 1-based, of the trajectory: the cut that frees it
  std::uint64_t voxels;  ///< those that were not said to fall
};

/// All that the cutters of a trajectory remove, in order: 8 bytes a row of voxels that lie side by side.
class CutterLog {
 public:
  /// `voxel_mm`: of the grid.
  CutterLog(int n, double voxel_mm) : n_(n), voxel_mm_(voxel_mm) {}

  /// One cut: all that it takes at once.
  void add(std::uint64_t line, const MillTool& tool, std::span<const Voxel> removed);

  /// What comes loose from layer k = 0 in pieces larger than a chip of the tool, which is as long as it is wide: exact,
  /// the cuts are undone from the last to the first until all of the stock stands again. `left`: what stands at the
  /// end. Calls `step` now and then; what that throws passes through.
  std::vector<FreedChunk> find_freed(const VoxelSet& left, const VoxelSet& may_fall,
                                     const std::function<void()>& step) const;

 private:
  struct Row {
    std::uint32_t first, count;  ///< by its index in a set
  };
  struct Cut {
    std::uint64_t line;
    double chip_voxels;
    std::size_t first_row;
  };

  int n_;
  double voxel_mm_;
  std::vector<Row> rows_;
  std::vector<Cut> cuts_;
};

}  // namespace sculpt
