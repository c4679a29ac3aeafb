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
  std::vector<std::size_t> ends;    ///< of each stroke that was followed to its end, how many keyframes that takes

  /// That many; the next one, if any, failed.
  std::size_t strokes() const { return ends.size(); }
  void cut_to(std::size_t strokes) {
    keyframes.resize(strokes == 0 ? 0 : ends[strokes - 1]);
    ends.resize(strokes);
  }
};

/// How far the body above the cutter may stray, and how far maps keep it off.
inline constexpr double body_stray_m = 2e-4, body_margin_m = body_stray_m + 1e-4;

/// From where the tip is at `from`. `direction`: the number of the field's direction in the plan. Depends on its
/// arguments only; any thread.
FollowedMill follow(const HeldTool& held, const PostureField& field, int direction, const Vec3& from,
                    const std::vector<MillStroke>& strokes);

}  // namespace sculpt
