// Single steps of the translating robot -> the longest straight runs.
#pragma once

#include <functional>

#include "core/search/voxel_run.hpp"

namespace sculpt {

/// Knows where the robot stands. A run is emitted as soon as the next step does not lengthen it.
class RunWriter {
 public:
  RunWriter(Voxel start, const std::function<void(const VoxelRun&)>& emit) : at_(start), emit_(emit) {}

  Voxel at() const { return at_; }

  /// Removes the straight line first..last; `first` is a face neighbour of where the robot stands.
  void cut(Voxel first, Voxel last) {
    cut_one(first);
    if (first == last) return;
    cut_one(first + sign(last - first));
    run_.last = at_ = last;
  }

  /// Goes straight to `voxel` through air.
  void travel(Voxel voxel) {
    if (voxel == at_) return;
    const Voxel step = sign(voxel - at_);
    if (!open_ || run_.cut || step != step_) {
      finish();
      run_ = {false, at_, voxel};
      open_ = true;
    }
    step_ = step;
    run_.last = at_ = voxel;
  }

  void finish() {
    if (open_) emit_(run_);
    open_ = false;
  }

 private:
  void cut_one(Voxel voxel) {
    const bool longer = open_ && run_.cut && (run_.first == run_.last || voxel - run_.last == step_);
    if (!longer) {
      finish();
      run_ = {true, voxel, voxel};
      open_ = true;
    }
    step_ = voxel - at_;
    run_.last = at_ = voxel;
  }

  Voxel at_;
  const std::function<void(const VoxelRun&)>& emit_;
  VoxelRun run_;
  Voxel step_;  ///< of the last move; for a cut of one voxel, how it was entered
  bool open_ = false;
};

}  // namespace sculpt
