// The .sct form of a trajectory: quantised, compressed, in segments that can be read one by one. docs/trajectory.md
// describes the bytes.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <memory>
#include <vector>

#include "core/trajectory/binary/file_segment.hpp"
#include "core/trajectory/header.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// Writes a segment to `out` as soon as it is full. Throws InputError `trajectory_invalid` for joint values that are no
/// multiples of the quantum and runs outside the grid. Not shared between threads.
class BinaryWriter {
 public:
  BinaryWriter(std::ostream& out, const TrajectoryHeader& header);
  ~BinaryWriter();
  void add(const Keyframe& keyframe);
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Random access; to read a file from its start to its end, TrajectoryReader is simpler and checks the hash too.
/// `in` must be binary and seekable and outlive the object. Everything throws InputError `trajectory_invalid` for bytes
/// that are not what they should be.
class BinaryFile {
 public:
  explicit BinaryFile(std::istream& in);

  const TrajectoryHeader& header() const { return header_; }
  std::uint64_t keyframes() const { return keyframes_; }
  std::uint64_t removed() const { return removed_; }
  const std::vector<FileSegment>& segments() const { return segments_; }

  /// The keyframes of one segment, its checksum checked.
  std::vector<Keyframe> read(std::size_t segment) const;
  /// The segment that removes the voxel with this ordinal, from 0 to removed() - 1 in the order of removal. Throws
  /// std::out_of_range for others.
  std::size_t segment_that_removes(std::uint64_t ordinal) const;

 private:
  std::istream& in_;
  TrajectoryHeader header_;
  std::uint64_t keyframes_ = 0, removed_ = 0;
  std::vector<FileSegment> segments_;
};

}  // namespace sculpt
