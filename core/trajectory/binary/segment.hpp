// Keyframes <-> the body of one .sct segment; docs/trajectory.md describes the bytes. Internal to trajectory/.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/trajectory/binary/cut_token.hpp"
#include "core/trajectory/binary/mill_token.hpp"
#include "core/trajectory/header.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

inline constexpr std::size_t max_segment_keyframes = 4096;

/// Where a milling tool is to be: columns behind those of the joints.
inline constexpr std::size_t tip_columns = 3;
/// Of numbers, in each body.
std::size_t columns_of(const TrajectoryHeader& header);
/// Upper bound of a body's bytes: no reader takes more memory than that for what a file promises.
std::size_t max_segment_bytes(std::size_t keyframes, std::size_t columns);

/// Not shared between threads.
class SegmentEncoder {
 public:
  /// All with as many joints. Throws InputError `trajectory_invalid` for a joint value that is no multiple of the
  /// quantum.
  void add(const Keyframe& keyframe);
  std::size_t keyframes() const { return keyframes_; }
  /// The body of those that were added; begins anew.
  std::string take();

 private:
  std::string tokens_;
  LastCut last_;
  LastPlace last_place_;
  std::vector<std::int64_t> quanta_;  ///< all columns of one keyframe after the other's
  std::size_t keyframes_ = 0;
};

/// Throws InputError `trajectory_invalid` that begins with `where` unless the body holds exactly `count` valid
/// keyframes.
std::vector<Keyframe> decode_segment(std::string_view body, std::size_t count, const TrajectoryHeader& header,
                                     const std::string& where);

}  // namespace sculpt
