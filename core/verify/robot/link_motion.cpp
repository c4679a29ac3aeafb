#include "core/verify/robot/link_motion.hpp"

#include <algorithm>
#include <cmath>

#include "core/verify/findings/slack.hpp"

namespace sculpt {
namespace {

std::vector<int> joints_to_root(const Robot& robot, int link) {
  std::vector<int> joints;
  while (robot.links[static_cast<std::size_t>(link)].parent_joint >= 0) {
    joints.push_back(robot.links[static_cast<std::size_t>(link)].parent_joint);
    link = robot.joints[static_cast<std::size_t>(joints.back())].parent_link;
  }
  return joints;
}

double axis_distance(const MovingJoint& joint, const std::vector<Frame>& poses, const Vec3& point) {
  const Frame& pose = poses[static_cast<std::size_t>(joint.link)];
  return (pose.linear() * joint.axis).cross(point - pose.translation()).norm();
}

}  // namespace

LinkMotion::LinkMotion(const Robot& robot, const std::vector<int>& joints, const std::vector<double>& rest,
                       int stock_link)
    : robot_(&robot), stock_link_(stock_link) {
  for (std::size_t index = 0; index < robot.joints.size(); ++index) {
    const Joint& joint = robot.joints[index];
    Step step{joint.origin, joint.kind, joint.axis.normalized(), joint.parent_link, joint.child_link, -1, 1, 0};
    step.origin.translation() *= mm;
    // A mimic joint may follow a mimic joint: value = rate * value of `source` + constant all along the way.
    int source = static_cast<int>(index);
    for (std::size_t hops = 0; robot.joints[static_cast<std::size_t>(source)].mimic >= 0 && hops < robot.joints.size();
         ++hops) {
      const Joint& follower = robot.joints[static_cast<std::size_t>(source)];
      step.constant += step.rate * follower.mimic_offset;
      step.rate *= follower.mimic_multiplier;
      source = follower.mimic;
    }
    const auto found = std::find(joints.begin(), joints.end(), source);
    if (found != joints.end() && joint.kind != JointKind::fixed) {
      step.coordinate = static_cast<int>(found - joints.begin());
    } else {
      step.constant += step.rate * rest[static_cast<std::size_t>(source)];
    }
    if (joint.kind == JointKind::prismatic) {
      step.rate *= mm;
      step.constant *= mm;
    }
    steps_.push_back(step);
  }
}

void LinkMotion::place_links(const Configuration& q, std::vector<Frame>& poses) const {
  poses.resize(robot_->links.size());
  poses[static_cast<std::size_t>(robot_->root)] = Frame::Identity();
  for (const Step& step : steps_)
    poses[static_cast<std::size_t>(step.child)] = poses[static_cast<std::size_t>(step.parent)] * move(step, q);
  const Frame to_stock = poses[static_cast<std::size_t>(stock_link_)].inverse();
  for (Frame& pose : poses) pose = to_stock * pose;
}

Frame LinkMotion::move(const Step& step, const Configuration& q) {
  const double value = step.coordinate < 0 ? step.constant : step.rate * q[step.coordinate] + step.constant;
  Frame local = step.origin;
  if (step.kind == JointKind::revolute) local.rotate(Eigen::AngleAxisd(value, step.axis));
  if (step.kind == JointKind::prismatic) local.translate(value * step.axis);
  return local;
}

LinkChain LinkMotion::chain(int from, int to) const {
  LinkChain chain;
  Frame still = Frame::Identity();
  int here = from;
  for (const int joint : path(*robot_, from, to)) {
    const Step& step = steps_[static_cast<std::size_t>(joint)];
    const bool outwards = step.parent == here;
    here = outwards ? step.child : step.parent;
    if (step.coordinate < 0) {
      const Frame moved = move(step, {});
      still = still * (outwards ? moved : moved.inverse());
      continue;
    }
    const Frame along(Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), step.axis));
    if (outwards) still = still * step.origin;
    const double sign = outwards ? 1 : -1;
    chain.hops_.push_back(
        {still * along, step.kind == JointKind::revolute, step.coordinate, sign * step.rate, sign * step.constant});
    still = along.inverse();
    if (!outwards) still = still * step.origin.inverse();
  }
  chain.after_ = still;
  return chain;
}

std::vector<int> LinkMotion::path(const Robot& robot, int from, int to) {
  std::vector<int> up = joints_to_root(robot, from), down = joints_to_root(robot, to);
  while (!up.empty() && !down.empty() && up.back() == down.back()) {
    up.pop_back();
    down.pop_back();
  }
  up.insert(up.end(), down.rbegin(), down.rend());
  return up;
}

std::vector<MovingJoint> LinkMotion::joints_between(int from, int to) const {
  std::vector<MovingJoint> moving;
  for (int joint : path(*robot_, from, to)) {
    const Step& step = steps_[static_cast<std::size_t>(joint)];
    if (step.coordinate >= 0)
      moving.push_back({step.coordinate, step.rate, step.kind == JointKind::revolute, step.child, step.axis});
  }
  return moving;
}

std::vector<double> lever_arms(const std::vector<MovingJoint>& joints, const std::vector<Frame>& poses,
                               const Vec3& centre, double radius) {
  std::vector<double> arms;
  arms.reserve(joints.size());
  for (const MovingJoint& joint : joints)
    arms.push_back(joint.turns ? axis_distance(joint, poses, centre) + radius : 0);
  return arms;
}

double motion_limit(const std::vector<MovingJoint>& joints, const std::vector<Frame>& poses, const Configuration& steps,
                    const Vec3& centre, double radius) {
  return motion_limit(joints, lever_arms(joints, poses, centre, radius),
                      [&](int coordinate) { return std::abs(steps[coordinate]); });
}

}  // namespace sculpt
