// All cuts of a trajectory, in order, and the pieces of material that they free. Internal to verify/.
#pragma once

#include <functional>
#include <vector>

#include "core/material/voxel_set.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// A voxel whose removal leaves others hanging on nothing that hung on something.
struct FreedPiece {
  std::uint64_t line;  ///< 1-based, of the trajectory
  Voxel removed;
  std::uint64_t voxels;
  std::uint64_t unforeseen;  ///< of them, those that were not said to fall
};

/// 12 bytes a cut.
class CutLog {
 public:
  explicit CutLog(int n) : n_(n) {}

  /// `line`: 1-based, of the trajectory.
  void add(const Keyframe& cut, std::uint64_t line);

  /// Needs cuts that remove every voxel once only, and only of `stock`: with `left` standing in the end they do so if
  /// this is true.
  bool removes_each_once(const VoxelSet& stock, const VoxelSet& left) const;

  /// Exact: the cuts are undone from the last to the first. Calls `step` now and then; what that throws passes through.
  std::vector<FreedPiece> find_freed(const VoxelSet& stock, const VoxelSet& may_fall,
                                     const std::function<void()>& step) const;

 private:
  struct Cut {
    std::uint32_t line, first, last;  ///< voxels by their index in a set
  };

  Voxel voxel(std::uint32_t index) const;

  int n_;
  std::uint64_t removed_ = 0;
  std::vector<Cut> cuts_;
};

}  // namespace sculpt
