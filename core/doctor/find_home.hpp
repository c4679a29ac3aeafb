// A configuration to begin and end plans at.
#pragma once

#include <optional>

#include "core/base/run_context.hpp"
#include "core/collision/scene.hpp"

namespace sculpt {

struct Home {
  Configuration q;
  double clearance_m = 0;   ///< of links that are not neighbours, the room and the stock, as far as 20 mm
  double limit_margin = 0;  ///< of the joint that is nearest to a limit: 0 at it, 1 in the middle
  double reach = 0;         ///< share of probes all over the stock that can be come to from there, tool upright
};

/// The best of the free configurations that are found from `start` and from random ones with the ball above the middle
/// of the stock and the tool pointing straight down; tilted ones where there is none, then any with the ball above the
/// stock. Best is what comes farthest in the stock, then what stays away from things and limits. Nothing where none
/// was found: that is no proof. `scene` has the full stock standing. Deterministic for a seed. Throws Cancelled.
std::optional<Home> find_home(const Scene& scene, const Configuration& start, const RunContext& run);

}  // namespace sculpt
