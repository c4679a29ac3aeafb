// What a keyframe of a plan with milling tools does: docs/trajectory.md, "Body". Internal to trajectory/.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "core/trajectory/binary/token_reader.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// What the next keyframe of a segment is told relative to.
struct LastPlace {
  int direction = -1;
  std::array<std::int64_t, 3> tip{};  ///< of the last keyframe that had one
};

/// `last` becomes the place of this keyframe, if it has one.
void append_mill_token(std::string& out, const Keyframe& keyframe, LastPlace& last);

/// All of the keyframe but joints and tip. Throws InputError `trajectory_invalid`.
void read_mill_token(TokenReader& bytes, Keyframe& keyframe, const TrajectoryHeader& header, LastPlace& last);

}  // namespace sculpt
