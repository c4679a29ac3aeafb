// Do two bodies that one joint moves against each other stay apart, wherever it stands?
#pragma once

#include "core/collision/shape/body.hpp"

namespace sculpt {

/// A motion along a screw or a line, in the frame of the link that is looked at as standing still.
struct OneJointMotion {
  Frame pose;  ///< of the moving link, at the beginning
  bool turns = true;
  Vec3 axis, point;  ///< unit vector; what turns about it turns through this point, else it is shifted along it
  double way = 0;    ///< that it goes in all (rad or m)
};

/// True if every part of `moves` stays more than `margin_m` off every part of `other` all along the motion. False where
/// that is not so, or could not be proved at little cost. Both trees and the motion are halved together, so that what
/// is far apart, or passes at another radius or height about the axis, is settled at once for all of the motion.
bool stay_apart(const Body& moves, const Body& other, const OneJointMotion& motion, double margin_m);

}  // namespace sculpt
