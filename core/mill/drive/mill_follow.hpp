// Strokes of a milling tool -> certified keyframes: the joints move linearly, and no point of the cutter strays further
// from where a straight motion has it than a stroke allows.
#pragma once

#include <vector>

#include "core/mill/drive/held_tool.hpp"
#include "core/mill/drive/mill_stroke.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

struct FollowedMill {
  std::vector<Keyframe> keyframes;  ///< each with its tip; cuts do not know yet what they remove
  std::size_t strokes = 0;          ///< that many were followed to their end; the next one, if any, failed
};

/// How far the body above the cutter may stray: maps grow it by so much.
inline constexpr double body_stray_m = 2e-4;

/// From where the tip is at `from`. `direction`: the number of the field's direction in the plan. Depends on its
/// arguments only; any thread.
FollowedMill follow(const HeldTool& held, const PostureField& field, int direction, const Vec3& from,
                    const std::vector<MillStroke>& strokes);

}  // namespace sculpt
