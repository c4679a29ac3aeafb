// What a keyframe cuts, told relative to the cut before it: docs/trajectory.md, "Body". Internal to trajectory/.
#pragma once

#include <cstdint>
#include <string>

#include "core/trajectory/keyframe.hpp"

namespace sculpt {

inline constexpr std::uint64_t token_move = 0, token_again = 1, first_cut_token = 2;
inline constexpr std::uint64_t directions = face_steps.size(), start_anywhere = 6, starts = 7;

/// What the next cut of a segment is told relative to.
struct LastCut {
  Voxel end{0, 0, 0};
  std::uint64_t direction = 0;  ///< of the `face_steps`
  std::uint64_t length = 1;
};

/// `last` becomes this cut; a move leaves it.
void append_token(std::string& out, const Keyframe& keyframe, LastCut& last);

}  // namespace sculpt
