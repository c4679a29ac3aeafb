// Keyframes -> the text form of a trajectory: newline-delimited JSON (docs/trajectory.md).
#pragma once

#include <iosfwd>
#include <memory>

#include "core/trajectory/header.hpp"
#include "core/trajectory/keyframe.hpp"
#include "core/trajectory/trajectory_end.hpp"
#include "core/trajectory/trajectory_start.hpp"

namespace sculpt {

/// Writes lines to `out` as they come; the text depends on nothing but the values. Not shared between threads.
class TrajectoryWriter {
 public:
  TrajectoryWriter(std::ostream& out, const TrajectoryHeader& header);
  ~TrajectoryWriter();
  void add(const Keyframe& keyframe);
  /// All that was added until now.
  TrajectoryStart so_far();
  TrajectoryEnd finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sculpt
