#include "core/verify/robot/joint_range.hpp"

#include <algorithm>
#include <optional>

#include "core/verify/robot/body_depth.hpp"

namespace sculpt {
namespace {

constexpr int max_parts = 4096;
// Over the rounding errors of depths and bounds.
constexpr double depth_slack_mm = 1e-6;

// One body with points of it, and the joints that move it as the other sees it.
struct Side {
  const SolidBody& body;
  std::vector<Vec3> points;
  std::vector<MovingJoint> joints;
};

enum class Depth { none, some, enough };

// How deep the deepest point of `moved` is inside `still`, seen against how far the range can move it.
Depth deepest(const Side& moved, const SolidBody& still, const std::vector<Frame>& poses, const JointRange& range) {
  const Frame at = pose_of(moved.body, poses), into = pose_of(still, poses).inverse();
  Depth found = Depth::none;
  for (const Vec3& point : moved.points) {
    const Vec3 place = at * point;
    const double depth = depth_in(still, into * place);
    if (depth <= depth_slack_mm) continue;
    found = Depth::some;
    if (motion_limit(moved.joints, poses, range.half, place, 0) + depth_slack_mm < depth) return Depth::enough;
  }
  return found;
}

// The coordinate whose part of the motion is the largest.
std::optional<int> widest(const Side& side, const std::vector<Frame>& poses, const JointRange& range) {
  const Vec3 centre = pose_of(side.body, poses).translation();
  const std::vector<double> arms = lever_arms(side.joints, poses, centre, side.body.radius);
  std::optional<int> best;
  double most = 0;
  for (std::size_t at = 0; at < side.joints.size(); ++at) {
    const MovingJoint& joint = side.joints[at];
    const double moved = std::abs(joint.rate) * range.half[joint.coordinate] * (joint.turns ? arms[at] : 1);
    if (moved <= most) continue;
    most = moved;
    best = joint.coordinate;
  }
  return best;
}

}  // namespace

JointRange joint_limits(const Robot& robot, const std::vector<int>& joints) {
  const auto size = static_cast<Eigen::Index>(joints.size());
  JointRange range{Configuration(size), Configuration(size)};
  for (Eigen::Index at = 0; at < size; ++at) {
    const Joint& joint = robot.joints[static_cast<std::size_t>(joints[static_cast<std::size_t>(at)])];
    range.middle[at] = (joint.lower + joint.upper) / 2;
    range.half[at] = (joint.upper - joint.lower) / 2;
  }
  return range;
}

bool overlap_everywhere(const SolidBody& a, const SolidBody& b, const LinkMotion& motion, const JointRange& range) {
  const Side first{a, points_of(a), motion.joints_between(b.link, a.link)};
  const Side second{b, points_of(b), motion.joints_between(a.link, b.link)};
  if (first.points.empty() || second.points.empty()) return false;
  std::vector<JointRange> open{range};
  std::vector<Frame> poses;
  for (int parts = 0; !open.empty(); ++parts) {
    if (parts == max_parts) return false;
    const JointRange part = open.back();
    open.pop_back();
    motion.place_links(part.middle, poses);
    const Depth depth = std::max(deepest(first, b, poses, part), deepest(second, a, poses, part));
    if (depth == Depth::enough) continue;
    const std::optional<int> cut = widest(second, poses, part);
    if (depth == Depth::none || !cut) return false;
    JointRange half = part;
    half.half[*cut] /= 2;
    for (int side : {-1, 1}) {
      half.middle[*cut] = part.middle[*cut] + side * half.half[*cut];
      open.push_back(half);
    }
  }
  return true;
}

}  // namespace sculpt
