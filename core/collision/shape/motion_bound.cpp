#include "core/collision/shape/motion_bound.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

/// A joint on the way from link to link; `up` when passed from child to parent.
struct Passage {
  int joint;
  bool up;
};

std::vector<int> joints_to_root(const Robot& robot, int link) {
  std::vector<int> joints;
  while (robot.links[static_cast<std::size_t>(link)].parent_joint >= 0) {
    joints.push_back(robot.links[static_cast<std::size_t>(link)].parent_joint);
    link = robot.joints[static_cast<std::size_t>(joints.back())].parent_link;
  }
  return joints;
}

std::vector<Passage> find_way(const Robot& robot, int from, int to) {
  std::vector<int> up = joints_to_root(robot, from), down = joints_to_root(robot, to);
  while (!up.empty() && !down.empty() && up.back() == down.back()) {
    up.pop_back();
    down.pop_back();
  }
  std::vector<Passage> way;
  way.reserve(up.size() + down.size());
  for (int joint : up) way.push_back({joint, true});
  for (auto joint = down.rbegin(); joint != down.rend(); ++joint) way.push_back({*joint, false});
  return way;
}

/// How far a prismatic joint can carry its child's origin away from where it is at 0.
double travel(const Joint& joint) {
  if (joint.kind != JointKind::prismatic) return 0;
  return std::max(std::abs(joint.lower), std::abs(joint.upper));
}

/// Largest distance between the origins (child frames) of two consecutive joints of a way.
double step_length(const Robot& robot, const Passage& here, const Passage& next) {
  const Joint& a = robot.joints[static_cast<std::size_t>(here.joint)];
  const Joint& b = robot.joints[static_cast<std::size_t>(next.joint)];
  if (here.up && next.up) return a.origin.translation().norm() + travel(a);
  if (!here.up) return b.origin.translation().norm() + travel(b);
  return (a.origin.translation() - b.origin.translation()).norm() + travel(a) + travel(b);
}

/// The coordinate that moves a joint, or -1, and what it is multiplied by.
struct Source {
  int coordinate;
  double rate;
};

Source source_of(const Chain& chain, int index) {
  const Joint& joint = chain.robot().joints[static_cast<std::size_t>(index)];
  const int source = joint.mimic >= 0 ? joint.mimic : index;
  const auto found = std::find(chain.joints().begin(), chain.joints().end(), source);
  if (found == chain.joints().end() || joint.kind == JointKind::fixed) return {-1, 0};
  return {static_cast<int>(found - chain.joints().begin()), joint.mimic >= 0 ? joint.mimic_multiplier : 1};
}

}  // namespace

Configuration motion_bound(const Chain& chain, int fixed, int moving, double extent_m) {
  const Robot& robot = chain.robot();
  const std::vector<Passage> way = find_way(robot, fixed, moving);
  Configuration bound = Configuration::Zero(chain.dof());
  double reach = extent_m;
  for (std::size_t at = way.size(); at-- > 0;) {
    const Joint& joint = robot.joints[static_cast<std::size_t>(way[at].joint)];
    if (at + 1 < way.size()) {
      reach += step_length(robot, way[at], way[at + 1]);
    } else if (way[at].up) {
      reach += joint.origin.translation().norm() + travel(joint);
    }
    const Source drive = source_of(chain, way[at].joint);
    if (drive.coordinate >= 0)
      bound[drive.coordinate] += std::abs(drive.rate) * (joint.kind == JointKind::revolute ? reach : 1);
  }
  return bound;
}

Configuration approach_bound(const Chain& chain, const LinkExtent& first, const LinkExtent& second) {
  const auto seen_from = [&](int between) -> Configuration {
    return motion_bound(chain, between, first.link, first.extent_m) +
           motion_bound(chain, between, second.link, second.extent_m);
  };
  Configuration least = seen_from(first.link);
  for (const Passage& passage : find_way(chain.robot(), first.link, second.link)) {
    const Joint& joint = chain.robot().joints[static_cast<std::size_t>(passage.joint)];
    if (const Configuration bound = seen_from(passage.up ? joint.parent_link : joint.child_link);
        bound.sum() < least.sum())
      least = bound;
  }
  return least;
}

Configuration turn_bound(const Chain& chain, int fixed, int moving) {
  Configuration bound = Configuration::Zero(chain.dof());
  for (const Passage& passage : find_way(chain.robot(), fixed, moving)) {
    const Source drive = source_of(chain, passage.joint);
    const Joint& joint = chain.robot().joints[static_cast<std::size_t>(passage.joint)];
    if (drive.coordinate >= 0 && joint.kind == JointKind::revolute) bound[drive.coordinate] += std::abs(drive.rate);
  }
  return bound;
}

std::vector<Drive> find_drives(const Chain& chain, int fixed, int moving) {
  std::vector<Drive> drives;
  for (const Passage& passage : find_way(chain.robot(), fixed, moving)) {
    const Source source = source_of(chain, passage.joint);
    if (source.coordinate >= 0)
      drives.push_back({passage.joint, source.coordinate, passage.up ? -source.rate : source.rate});
  }
  return drives;
}

JointColumns<6> relative_twist(const Chain& chain, const std::vector<Drive>& drives, const std::vector<Frame>& poses) {
  JointColumns<6> twist = JointColumns<6>::Zero(6, chain.dof());
  for (const Drive& drive : drives) {
    const Joint& joint = chain.robot().joints[static_cast<std::size_t>(drive.joint)];
    const Frame& child = poses[static_cast<std::size_t>(joint.child_link)];
    const Vec3 axis = drive.rate * (child.linear() * joint.axis);
    if (joint.kind == JointKind::prismatic) {
      twist.col(drive.coordinate).head<3>() += axis;
    } else {
      twist.col(drive.coordinate).head<3>() += child.translation().cross(axis);
      twist.col(drive.coordinate).tail<3>() += axis;
    }
  }
  return twist;
}

}  // namespace sculpt
