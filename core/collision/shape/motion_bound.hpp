// How far a link's points can move, per unit of each joint: the bound behind every certificate
// (Schwarzer, Saha, Latombe, "Exact collision checking of robot paths", WAFR 2002).
#pragma once

#include "core/cell/chain.hpp"

namespace sculpt {

/// Upper bounds, per coordinate of `chain`, on the speed (m per rad, or m per m) of any point within `extent_m` of the
/// origin of link `moving`, seen from link `fixed`; 0 for coordinates that do not move the two against each other.
/// Holds at every configuration within the limits.
Configuration motion_bound(const Chain& chain, int fixed, int moving, double extent_m);

/// A link and what is fixed to it: no point is farther from its origin.
struct LinkExtent {
  int link;
  double extent_m;
};
/// Upper bounds, per coordinate of `chain`, on how fast points of two links come nearer to each other (m per rad, or m
/// per m), at every configuration within the limits. Seen from a link between the two each joint moves one of them
/// only: of those links, both ends included, the one whose bounds add up to least.
Configuration approach_bound(const Chain& chain, const LinkExtent& first, const LinkExtent& second);

/// Upper bounds, per coordinate, on how fast link `moving` turns seen from link `fixed` (rad per unit).
Configuration turn_bound(const Chain& chain, int fixed, int moving);

/// The joints that move one link against another.
struct Drive {
  int joint;
  int coordinate;  ///< of the chain
  double rate;     ///< of the joint per unit of its coordinate, negative where it is passed from child to parent
};
/// From link `fixed` to link `moving`, in this order; only those that the chain moves.
std::vector<Drive> find_drives(const Chain& chain, int fixed, int moving);

/// How the link at the end of `drives` moves seen from the one at their beginning, per unit of each coordinate: rows
/// 0-2 the velocity of its point at the stock's origin (m), rows 3-5 its turning (rad); stock frame. `poses` as
/// Chain::link_poses gives them.
JointColumns<6> relative_twist(const Chain& chain, const std::vector<Drive>& drives, const std::vector<Frame>& poses);

/// Bounds on the second, third and fourth derivative by t of a point along q + t * step (m). `turning_rad`, `travel_m`:
/// turn_bound and motion_bound for it, times |step|. A derivative is a sum of turnings about joints applied to the
/// motion by the joint of them that comes last. Of turning joints none is slower than a later one, so the sum over all
/// orders needs no order; a shift may be faster than an earlier turn and is counted in every place.
struct DerivativeBounds {
  double second_m, third_m, fourth_m;
};
inline DerivativeBounds derivative_bounds(const Chain& chain, double turning_rad, double travel_m) {
  const double second_m = turning_rad * travel_m, third_m = turning_rad * second_m, fourth_m = turning_rad * third_m;
  if (!chain.shifts()) return {second_m, third_m, fourth_m};
  return {2 * second_m, 3 * third_m, 4 * fourth_m};
}

}  // namespace sculpt
