// The replay's own kinematics: where every link is, and how far things move meanwhile. Millimetres, stock frame.
#pragma once

#include <cmath>
#include <vector>

#include "core/cell/cell.hpp"
#include "core/verify/robot/link_chain.hpp"

namespace sculpt {

/// A joint that moves with a coordinate of the trajectory.
struct MovingJoint {
  int coordinate = 0;
  double rate = 1;    ///< joint value per unit of the coordinate; mm for prismatic joints. Not 1 for mimic joints
  bool turns = true;  ///< revolute
  int link = 0;       ///< child link: its origin is on the axis
  Vec3 axis = Vec3::UnitZ();
};

/// Immutable after construction.
class LinkMotion {
 public:
  /// `joints`: robot joint of each coordinate; all others stand at `rest`, mimic joints follow.
  LinkMotion(const Robot& robot, const std::vector<int>& joints, const std::vector<double>& rest, int stock_link);

  /// Pose of every link; `poses` is resized.
  void place_links(const Configuration& q, std::vector<Frame>& poses) const;

  /// From the one link to the other.
  LinkChain chain(int from, int to) const;

  /// The moving joints on the tree path from one link to another, nearest to `from` first.
  std::vector<MovingJoint> joints_between(int from, int to) const;

  /// The robot joints on that path, moving or not, nearest to `from` first.
  static std::vector<int> path(const Robot& robot, int from, int to);

 private:
  struct Step {
    Frame origin;  // of the joint, in the parent link
    JointKind kind;
    Vec3 axis;
    int parent, child;
    int coordinate;         // -1: stands still
    double rate, constant;  // value = rate * coordinate + constant, in mm for prismatic joints
  };

  static Frame move(const Step& step, const Configuration& q);

  const Robot* robot_;
  int stock_link_;
  std::vector<Step> steps_;
};

/// Distance of `centre` from the axis of each joint, grown by `radius`; 0 for joints that shift.
std::vector<double> lever_arms(const std::vector<MovingJoint>& joints, const std::vector<Frame>& poses,
                               const Vec3& centre, double radius);

/// Bound on how far a point within the radius of the centre that `arms` were measured for (fixed to the far end of
/// `joints`) moves, seen from their near end, while coordinate c moves by no more than `step_of(c)` from there.
/// From the far end inwards: `moved` bounds the point's motion seen from beyond each joint; a turn by `step` about an
/// axis at distance d adds at most step * (d + moved), a shift adds step (cf. Schwarzer, Saha, Latombe, WAFR 2002).
template <typename StepOf>
double motion_limit(const std::vector<MovingJoint>& joints, const std::vector<double>& arms, StepOf&& step_of) {
  double moved = 0;
  for (std::size_t at = joints.size(); at-- > 0;) {
    const double step = std::abs(joints[at].rate) * step_of(joints[at].coordinate);
    moved += joints[at].turns ? step * (arms[at] + moved) : step;
  }
  return moved;
}

/// The same, from where `poses` are.
double motion_limit(const std::vector<MovingJoint>& joints, const std::vector<Frame>& poses, const Configuration& steps,
                    const Vec3& centre, double radius);

}  // namespace sculpt
