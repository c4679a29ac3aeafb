// How far a link's points can move, per unit of each joint: the bound behind every certificate
// (Schwarzer, Saha, Latombe, "Exact collision checking of robot paths", WAFR 2002).
#pragma once

#include "core/cell/chain.hpp"

namespace sculpt {

/// Upper bounds, per coordinate of `chain`, on the speed (m per rad, or m per m) of any point within `extent_m` of the
/// origin of link `moving`, seen from link `fixed`; 0 for coordinates that do not move the two against each other.
/// Holds at every configuration within the limits.
Eigen::VectorXd motion_bound(const Chain& chain, int fixed, int moving, double extent_m);

}  // namespace sculpt
