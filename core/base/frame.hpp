// The few names for vectors and frames that everything else uses. Metres and radians.
#pragma once

#include <Eigen/Geometry>

namespace sculpt {

using Vec3 = Eigen::Vector3d;
/// A rigid pose: maps points of the named frame into the frame it is given in.
using Frame = Eigen::Isometry3d;
/// Of a `Chain`: so that configurations need no memory of their own.
inline constexpr int max_joints = 16;
/// One value per coordinate of a `Chain`: rad for revolute, m for prismatic joints.
using Configuration = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_joints, 1>;
/// One column per coordinate.
template <int Rows>
using JointColumns = Eigen::Matrix<double, Rows, Eigen::Dynamic, 0, Rows, max_joints>;

}  // namespace sculpt
