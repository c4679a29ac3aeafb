// What every voxel is at the start, and which are cut when: docs/trajectory.md, "The timeline".
#pragma once

#include <iosfwd>
#include <string>

#include "core/material/voxel_grid.hpp"
#include "core/trajectory/binary/cut_token.hpp"
#include "core/trajectory/header.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// Appends to `out`, which must outlive it, and never changes what it wrote: who reads it while it grows sees what is
/// final. The bytes depend on nothing but the values. Not shared between threads.
class TimelineWriter {
 public:
  TimelineWriter(std::ostream& out, const TrajectoryHeader& header, const VoxelGrid& voxels);
  void add(const Keyframe& keyframe);
  /// What was added so far goes to `out`, which is flushed.
  void flush();

 private:
  std::ostream& out_;
  std::string unsent_;
  LastCut last_;
  std::size_t in_segment_ = 0;  ///< keyframes
};

}  // namespace sculpt
