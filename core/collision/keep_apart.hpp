// Planes between two bodies that move against each other, as half-spaces of joint values.
#pragma once

#include <vector>

#include "core/collision/bubble.hpp"
#include "core/collision/shape/body.hpp"

namespace sculpt {

/// How a body moves in a box of joint values about a configuration, in the frame of another body's link.
struct RelativeMotion {
  Frame pose;  ///< of its link, at the configuration
  /// First derivatives of its point at the frame's origin (m per unit of each joint), and of its turning (rad).
  JointColumns<3> velocity, turn;
  Configuration half;  ///< the box
  double reach_m;      ///< no point moves farther in the box
  double remainder_m;  ///< what derivatives of higher order add to the first, at most
};

enum class Nearness { touch_nowhere, kept_apart, too_near };

/// Do the bodies stay more than `margin_m` apart as `mover` moves? Nowhere in the box do they touch, or they do not
/// where all half-spaces hold that are added to `half_spaces`; those hold all of `wanted` (steps from the
/// configuration) and the configuration itself. Or nothing is added, and they may be too near at one of these. Coarse
/// parts are kept apart where that does, finer ones elsewhere.
Nearness keep_apart(const Body& mover, const RelativeMotion& motion, const Body& other, double margin_m,
                    const std::vector<Configuration>& wanted, std::vector<Bubble::HalfSpace>& half_spaces);

}  // namespace sculpt
