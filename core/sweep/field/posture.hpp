// A configuration for one ball position with the tool's axis given, close to a guess.
#pragma once

#include <optional>

#include "core/cell/chain.hpp"

namespace sculpt {

/// Gauss-Newton with the least joint motion from `guess` (5 rows: position, axis), rounded as it is stored; nothing if
/// it does not converge in a few steps or ends outside the limits. A smooth function of position and guess, so that
/// neighbouring positions get neighbouring configurations. `ball_m`, `axis` (unit vector, ball to spindle) in the stock
/// frame.
std::optional<Configuration> find_posture(const Chain& chain, const Vec3& ball_m, const Vec3& axis,
                                          const Configuration& guess);

}  // namespace sculpt
