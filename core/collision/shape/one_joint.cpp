#include "core/collision/shape/one_joint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sculpt {
namespace {

using Node = ShapeTree::Node;

/// Pairs of nodes that are looked at, of bodies that nearly touch: then it is given up.
constexpr int max_node_pairs = 1'000'000;

/// Where a node is about the axis, whatever the joint does: heights along it and radii.
struct Profile {
  double low = 0, high = 0, inner = 0, outer = 0;

  double gap(const Profile& other) const {
    return std::max({low - other.high, other.low - high, inner - other.outer, other.inner - outer});
  }
};

/// `axis`, `point`: in the frame of the tree.
Profile profile_of(const Convex& shape, const Vec3& axis, const Vec3& point) {
  const Vec3 centre = shape.centre() - point;
  const Vec3 out = (centre - axis * axis.dot(centre)).stableNormalized();
  const Convex::Corners corners = shape.corners();
  const double anything = std::numeric_limits<double>::max();
  Profile profile{anything, -anything, anything, 0};
  for (std::size_t at = 0; at < corners.count; ++at) {
    const Vec3 corner = corners.points[at] - point;
    const double height = axis.dot(corner);
    profile.low = std::min(profile.low, height);
    profile.high = std::max(profile.high, height);
    profile.inner = std::min(profile.inner, out.dot(corner));
    profile.outer = std::max(profile.outer, (corner - axis * height).norm());
  }
  return {profile.low - corners.radius, profile.high + corners.radius, std::max(0.0, profile.inner - corners.radius),
          profile.outer + corners.radius};
}

std::vector<Profile> profiles_of(const ShapeTree& tree, const Vec3& axis, const Vec3& point) {
  std::vector<Profile> profiles;
  for (const Node& node : tree.nodes) profiles.push_back(profile_of(node.shape, axis, point));
  return profiles;
}

/// Two trees, one of which moves, in the frame of the other.
class MovingPair {
 public:
  MovingPair(const ShapeTree& moves, const ShapeTree& other, const OneJointMotion& motion, double margin_m, int& looks)
      : moves_(moves), other_(other), motion_(motion), margin_(margin_m), looks_left_(looks) {
    if (!motion.turns) return;
    const Frame back = motion.pose.inverse();
    moving_profiles_ = profiles_of(moves, back.linear() * motion.axis, back * motion.point);
    other_profiles_ = profiles_of(other, motion.axis, motion.point);
  }

  bool stay_apart() { return stay_apart(0, 0, 0, motion_.way); }

 private:
  Frame pose_at(double way) const {
    if (!motion_.turns) return Eigen::Translation3d(way * motion_.axis) * motion_.pose;
    return Eigen::Translation3d(motion_.point) * Eigen::AngleAxisd(way, motion_.axis) *
           Eigen::Translation3d(-motion_.point) * motion_.pose;
  }

  bool stay_apart(std::size_t one, std::size_t two, double from, double to) {
    if (motion_.turns && moving_profiles_[one].gap(other_profiles_[two]) > margin_) return true;
    if (looks_left_-- <= 0) return false;
    const Node &moving = moves_.nodes[one], &standing = other_.nodes[two];
    const bool leaves = moving.is_leaf() && standing.is_leaf();
    const double middle = (from + to) / 2,
                 radius = motion_.turns ? std::min(moving_profiles_[one].outer, other_profiles_[two].outer) : 1;
    const double travel = radius * std::abs(to - from) / 2, enough = travel + margin_;
    const Convex placed = moving.shape.placed(pose_at(middle));
    if (separate(placed, standing.shape, std::nextafter(enough, 1e9), effort(leaves)).gap > enough) return true;
    if (leaves && travel < margin_ / 2) return false;
    const double moving_extent = moving.is_leaf() ? -1 : moving.shape.extent(),
                 standing_extent = standing.is_leaf() ? -1 : standing.shape.extent();
    if (leaves || travel > std::max(moving_extent, standing_extent))
      return stay_apart(one, two, from, middle) && stay_apart(one, two, middle, to);
    const bool split_moving = moving_extent >= standing_extent;
    const Node& node = split_moving ? moving : standing;
    for (int child = 0; child < node.children; ++child) {
      const auto below = static_cast<std::size_t>(node.first_child + child);
      if (!(split_moving ? stay_apart(below, two, from, to) : stay_apart(one, below, from, to))) return false;
    }
    return true;
  }

  const ShapeTree &moves_, &other_;
  const OneJointMotion& motion_;
  double margin_;
  int& looks_left_;
  std::vector<Profile> moving_profiles_, other_profiles_;
};

}  // namespace

bool stay_apart(const Body& moves, const Body& other, const OneJointMotion& motion, double margin_m) {
  int looks_left = max_node_pairs;
  for (const Body::Part& part : moves.parts)
    for (const Body::Part& of_other : other.parts)
      if (!MovingPair(*part.tree, *of_other.tree, motion, margin_m, looks_left).stay_apart()) return false;
  return true;
}

}  // namespace sculpt
