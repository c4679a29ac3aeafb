// Keyframes <-> the body of one .sct segment; docs/trajectory.md describes the bytes. Internal to trajectory/.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/trajectory/trajectory.hpp"

namespace sculpt {

inline constexpr std::size_t most_segment_keyframes = 4096;

/// Upper bound of a body's bytes: no reader takes more memory than that for what a file promises.
std::size_t longest_segment(std::size_t keyframes, std::size_t joints);

/// Throws InputError `trajectory_invalid` for a joint value that is no multiple of the quantum.
std::string encode_segment(std::span<const Keyframe> keyframes);

/// Throws InputError `trajectory_invalid` that begins with `where` unless the body holds exactly `count` valid
/// keyframes.
std::vector<Keyframe> decode_segment(std::string_view body, std::size_t count, const TrajectoryHeader& header,
                                     const std::string& where);

}  // namespace sculpt
