// The few names for vectors and frames that everything else uses. Metres and radians.
#pragma once

#include <Eigen/Geometry>

namespace sculpt {

using Vec3 = Eigen::Vector3d;
/// A rigid pose: maps points of the named frame into the frame it is given in.
using Frame = Eigen::Isometry3d;
/// One value per coordinate of a `Chain`: rad for revolute, m for prismatic joints.
using Configuration = Eigen::VectorXd;

}  // namespace sculpt
