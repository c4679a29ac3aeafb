// How the tip comes down where nothing is open beside it: along a ramp, as a slot is cut.
//
// Seen from the side, along an open curve; around a closed one it goes on as a helix:
//
//        top  o-.._
//                  `-.._         to and fro: where it turns back it is twice as deep as on average
//               _..-`--'`
//        o-..-`
//        `----------------o      the last time at the bottom
#pragma once

#include <vector>

#include "core/mill/map/level_curves.hpp"

namespace sculpt {

/// Places (tool frame) from `top` down to `bottom` (heights, m) along a curve, the first one at its beginning; nowhere
/// more than `slot_m` deeper than the time before, nor steeper than 0.15. Nothing if it were to go along it more than
/// twenty times.
std::vector<Vec3> ramp_along(const Curve& curve, bool is_closed, double top, double bottom, double slot_m);

}  // namespace sculpt
