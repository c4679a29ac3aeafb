// Inverse kinematics: a tool position, and optionally a tool axis, to a configuration inside the joint limits.
#pragma once

#include <optional>

#include "core/cell/chain.hpp"

namespace sculpt {

/// Ball centre in the stock frame (m); `axis` = unit vector from the ball towards the spindle, free if absent.
struct IkGoal {
  Vec3 ball_m;
  std::optional<Vec3> axis;
};

struct IkSettings {
  double position_tolerance_m = 1e-7;
  double axis_tolerance_rad = 1e-5;
  int max_steps = 80;
  double max_step_rad = 0.3;  ///< longest change of one joint in one step (also used in m for prismatic joints)
  double centring =
      0.05;  ///< pull of the spare freedom towards the middle of the joint limits, per step; 0 = stay near the seed
  bool respect_limits = true;
};

/// Damped Gauss-Newton from `seed` with the spare freedom pulled towards mid-range. Deterministic. The result meets the
/// tolerances and (if asked) the limits, or there is none: "not found from this seed" is not "unreachable".
std::optional<Configuration> solve_ik(const Chain& chain, const IkGoal& goal, const Configuration& seed,
                                      const IkSettings& settings = {});

}  // namespace sculpt
