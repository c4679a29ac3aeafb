// The way from one point of a plan to the next, by r. Internal to core/timing.
#pragma once

#include "core/cell/chain.hpp"

namespace sculpt {

/// Bounds of what the tool does per unit of each joint.
struct ToolRates {
  explicit ToolRates(const Chain& chain);

  const Chain& chain;
  Configuration travel;  ///< m, of any point of the tool
  Configuration turn;    ///< rad
  double stickout_m;

  /// What a joint step's second derivative may be more than turning * travel: where something shifts.
  double orders(int order) const { return chain.shifts() ? order : 1; }
};

/// How ball and shank's upper end move.
struct ToolMotion {
  Vec3 ball = Vec3::Zero(), top = Vec3::Zero();
};

/// The tool where it is and how it moves by each joint.
struct ToolPlace {
  void put(const ToolRates& rates, const Configuration& q);

  ToolPose pose;
  JointColumns<6> jacobian;
  Vec3 ball(const Configuration& step) const { return jacobian.topRows<3>() * step; }
  ToolMotion motion(const Configuration& step, double stickout_m) const {
    const Eigen::Matrix<double, 6, 1> twist = jacobian * step;
    return {twist.head<3>(), twist.head<3>() + twist.tail<3>().cross(stickout_m * pose.axis)};
  }
};

struct PathEdge {
  Configuration way;            ///< q' by r
  ToolMotion begin, end;        ///< at its ends (m by r)
  double length = 0;            ///< e
  double ball = 0;              ///< the ball's largest speed (m by r)
  double turn = 0, travel = 0;  ///< bounds, of the tool, by r
  double joint_rate = 0;        ///< 1 / (largest r' by the joints' velocities)
  double line_acceleration = 0;
  double cap = 0;  ///< largest r', feed or rapid included
  double feed_m_s = 0;
  bool cut = false;
};

/// Where the tool is at both ends of an edge.
struct EdgePlaces {
  ToolPlace begin, end;
};

/// How far ball and shank's end leave the straight line between where an edge begins and ends (m): at a share t of it
/// by no more than 4 sagitta t (1 - t) + 16 more t^2 (1 - t)^2. By the cubic through the ends with the derivatives
/// there, and what it leaves out, a bound of the fourth derivative over 384.
struct EdgeSagitta {
  double ball = 0, top = 0, more = 0;
};
EdgeSagitta sagitta_of(const ToolRates& rates, const PathEdge& edge, const EdgePlaces& places);

/// What the joints may do, as edges are measured by.
struct JointRates {
  const Configuration &acceleration, &velocity;
};

/// From `start` to `end`, which differ; the tool is at `start` already, places.end is set.
PathEdge make_edge(const ToolRates& rates, const JointRates& joints, const Configuration& start,
                   const Configuration& end, EdgePlaces& places);

}  // namespace sculpt
