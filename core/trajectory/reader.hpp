// Trajectory file, in the text or the binary form -> keyframes.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>

#include "core/trajectory/header.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

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
