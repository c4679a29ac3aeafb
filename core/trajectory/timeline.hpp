// What every voxel is at the start, and which are cut when: docs/trajectory.md, "The timeline".
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/material/voxel_grid.hpp"
#include "core/trajectory/binary/cut_token.hpp"
#include "core/trajectory/header.hpp"
#include "core/trajectory/keyframe.hpp"
#include "core/trajectory/milling/milled_stock.hpp"

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
  std::optional<MilledStock> milled_;
};

/// A keyframe, as far as a timeline tells of it.
struct TimelineStep {
  bool cut = false;
  std::vector<std::pair<Voxel, Voxel>> runs;  ///< that go, one after the other: first and last voxel of each
  int tool = -1;                              ///< a change to this one of the header's
};

/// Reads what TimelineWriter wrote; `bytes` must outlive it. Whatever has a beginning may end anywhere, as one does
/// that grows; the beginning must be whole. Throws InputError `trajectory_invalid`. Not shared between threads.
class TimelineReader {
 public:
  explicit TimelineReader(std::string_view bytes);
  ~TimelineReader();
  const TrajectoryHeader& header() const;
  /// At the start.
  const VoxelGrid& voxels() const;
  /// The next keyframe that is there as a whole.
  std::optional<TimelineStep> next();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sculpt
