#include "core/collision/link_pairs.hpp"

#include <algorithm>
#include <set>

#include "core/base/random.hpp"
#include "core/cell/link_poses.hpp"
#include "core/collision/fcl_shape.hpp"

namespace sculpt {
namespace {

constexpr int sample_count = 300;

struct Geometry {
  Frame pose;  // in the link's frame
  std::shared_ptr<fcl::CollisionGeometryd> shape;
};

std::vector<std::vector<Geometry>> make_geometries(const Robot& robot) {
  std::vector<std::vector<Geometry>> all(robot.links.size());
  for (std::size_t link = 0; link < robot.links.size(); ++link)
    for (const Shape& shape : robot.links[link].shapes) all[link].push_back({shape.pose, make_fcl_geometry(shape, 0)});
  return all;
}

std::vector<double> sample_joints(const Robot& robot, Random& random) {
  std::vector<double> values(robot.joints.size(), 0);
  for (std::size_t j = 0; j < values.size(); ++j)
    values[j] = random.between(robot.joints[j].lower, robot.joints[j].upper);
  for (std::size_t j = 0; j < values.size(); ++j) {
    const Joint& joint = robot.joints[j];
    if (joint.mimic >= 0)
      values[j] = joint.mimic_multiplier * values[static_cast<std::size_t>(joint.mimic)] + joint.mimic_offset;
  }
  return values;
}

bool touch(const std::vector<Geometry>& first, const Frame& pose_first, const std::vector<Geometry>& second,
           const Frame& pose_second) {
  for (const Geometry& a : first)
    for (const Geometry& b : second)
      if (fcl_touch(*a.shape, to_fcl(pose_first * a.pose), *b.shape, to_fcl(pose_second * b.pose))) return true;
  return false;
}

}  // namespace

std::vector<int> rigid_groups(const Robot& robot) {
  std::vector<int> group(robot.links.size());
  for (std::size_t link = 0; link < group.size(); ++link) group[link] = static_cast<int>(link);
  for (const Joint& joint : robot.joints)
    if (joint.kind == JointKind::fixed)
      group[static_cast<std::size_t>(joint.child_link)] = group[static_cast<std::size_t>(joint.parent_link)];
  return group;
}

std::vector<std::pair<int, int>> find_link_pairs(const Robot& robot) {
  const std::vector<int> group = rigid_groups(robot);
  std::set<std::pair<int, int>> joined;  // groups across one joint
  for (const Joint& joint : robot.joints) {
    const int a = group[static_cast<std::size_t>(joint.parent_link)];
    const int b = group[static_cast<std::size_t>(joint.child_link)];
    joined.insert(std::minmax(a, b));
  }
  std::vector<std::pair<int, int>> pairs;
  for (int a = 0; a < static_cast<int>(robot.links.size()); ++a)
    for (int b = a + 1; b < static_cast<int>(robot.links.size()); ++b) {
      const int group_a = group[static_cast<std::size_t>(a)], group_b = group[static_cast<std::size_t>(b)];
      if (robot.links[static_cast<std::size_t>(a)].shapes.empty() ||
          robot.links[static_cast<std::size_t>(b)].shapes.empty())
        continue;
      if (group_a == group_b || joined.count(std::minmax(group_a, group_b)) > 0) continue;
      pairs.emplace_back(a, b);
    }

  const auto geometries = make_geometries(robot);
  std::vector<bool> parted(pairs.size(), false);  // seen apart at least once
  Random random(1);
  for (int sample = 0; sample < sample_count; ++sample) {
    const std::vector<Frame> poses = link_poses(robot, sample_joints(robot, random));
    for (std::size_t at = 0; at < pairs.size(); ++at) {
      if (parted[at]) continue;
      const auto a = static_cast<std::size_t>(pairs[at].first), b = static_cast<std::size_t>(pairs[at].second);
      parted[at] = !touch(geometries[a], poses[a], geometries[b], poses[b]);
    }
  }
  std::vector<std::pair<int, int>> kept;
  for (std::size_t at = 0; at < pairs.size(); ++at)
    if (parted[at]) kept.push_back(pairs[at]);
  return kept;
}

}  // namespace sculpt
