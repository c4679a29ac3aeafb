// The plan as it leaves the planner: a header and keyframes, as newline-delimited JSON (DESIGN section 5 names the
// fields).
#pragma once

#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/cell/tool.hpp"
#include "core/material/placement.hpp"
#include "core/material/voxel.hpp"

namespace sculpt {

struct TrajectoryHeader {
  std::vector<std::string> joints;  ///< names of the chain's coordinates
  Configuration home;
  Grid grid;  ///< resolution, voxel_m, origin_m
  Tool tool;
  double tolerance_m = 0;    ///< how far the ball's centre may be from a voxel's centre when it removes it
  std::string cell, search;  ///< names, for people
  std::uint64_t seed = 0;
  bool held = false;  ///< of a translating robot's plan: no cut frees a piece that may not fall; of others always so
};

/// Linear joint motion from the previous keyframe (the first one starts at home) to q. A cut removes the straight run
/// of voxels first..last (along one axis), the m-th of n at path parameter m/n; a move removes nothing.
struct Keyframe {
  Configuration q;
  bool cut = false;
  Voxel first, last;
};

/// Number of voxels of a cut's run.
int run_length(const Keyframe& keyframe);

struct TrajectoryEnd {
  std::uint64_t keyframes = 0, removed = 0;
  std::string sha256;  ///< of every byte before the end line
};

/// The first lines of a trajectory file in the text form, header included.
struct TrajectoryStart {
  std::uint64_t keyframes = 0, bytes = 0;
  std::string sha256;  ///< of these bytes
  bool operator==(const TrajectoryStart&) const = default;
};

/// Joint values as they are stored: multiples of 1e-7 rad or m, so that the text read back gives the same double.
/// Planners certify rounded values.
Configuration rounded(const Configuration& q);
/// The same for a `q` within joint limits that need not be multiples themselves: what would be rounded past a limit is
/// rounded to the inside, less than one quantum away.
Configuration rounded(const Configuration& q, const Configuration& lower, const Configuration& upper);

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

/// Reads what TrajectoryWriter or BinaryWriter wrote, a keyframe at a time; it sees from the first byte which of them
/// it was. Throws InputError `trajectory_invalid` with the line or byte, also for a missing end, wrong counts or a
/// wrong hash.
class TrajectoryReader {
 public:
  explicit TrajectoryReader(std::istream& in);
  ~TrajectoryReader();
  const TrajectoryHeader& header() const;
  /// The next keyframe, or nothing after the end was read and its counts and hash agreed.
  std::optional<Keyframe> next();
  /// 1-based line of the keyframe that `next` gave last, in the text form.
  std::uint64_t line() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sculpt
