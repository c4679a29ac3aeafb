// A straight line of the ball, axis held -> certified joint edges.
#pragma once

#include <optional>
#include <vector>

#include "core/cell/ik.hpp"
#include "core/collision/scene.hpp"

namespace sculpt {

/// Joint path along the straight line from the tool pose at `from` to the ball at `ball_m` (stock frame), the axis held
/// at `axis`; edges are as long as IK and certificate allow, `from` is not repeated. Empty if the line cannot be
/// tracked freely; then `contact`, if given, says what was hit (none: no IK solution near the last one).
std::optional<std::vector<Configuration>> track_line(const Scene& scene, const Configuration& from, const Vec3& ball_m,
                                                     const Vec3& axis, Contact* contact = nullptr);

/// IK with the result rounded as it will be stored.
std::optional<Configuration> solve_rounded(const Chain& chain, const IkGoal& goal, const Configuration& seed);

}  // namespace sculpt
