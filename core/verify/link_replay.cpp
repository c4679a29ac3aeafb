#include "core/verify/link_replay.hpp"

#include <algorithm>

#include "core/verify/findings/slack.hpp"

namespace sculpt {
namespace {

// Two things that can come closer than this while they move this little are reported: nobody could prove that they do
// not touch.
constexpr double too_close_mm = 0.01;

Vec3 centre_of(const SolidBody& body, const std::vector<Frame>& poses) {
  return poses[static_cast<std::size_t>(body.link)] * body.pose.translation();
}

bool joined_rigidly(const Robot& robot, int a, int b) {
  for (int joint : LinkMotion::path(robot, a, b))
    if (robot.joints[static_cast<std::size_t>(joint)].kind != JointKind::fixed) return false;
  return true;
}

}  // namespace

LinkReplay::LinkReplay(const Cell& cell, const LinkMotion& motion, const std::vector<SolidBody>& bodies,
                       const std::vector<std::pair<const SolidBody*, const SolidBody*>>& apart,
                       const StandingVoxels& material)
    : cell_(cell),
      motion_(motion),
      material_(material),
      origin_(1000 * cell.stock_origin_m),
      voxel_(material.voxel_mm()) {
  for (const SolidBody& body : bodies)
    if (!joined_rigidly(cell.robot, cell.stock_link, body.link)) add_pair(body, nullptr);
  for (const auto& [first, second] : apart) add_pair(*first, second);
}

void LinkReplay::add_pair(const SolidBody& first, const SolidBody* second) {
  const bool first_is_mesh = first.kind == ShapeKind::mesh,
             second_is_mesh = second != nullptr && second->kind == ShapeKind::mesh;
  if (first_is_mesh && second != nullptr && !second_is_mesh)
    return add_pair(*second, &first);  // the first one is grown, a mesh cannot
  const Around around{first.link, first.pose.translation(), first.radius};
  if (second == nullptr) {
    const Around block{cell_.stock_link, Vec3::Zero(), -1};
    pairs_.push_back({&first, nullptr, KeptClearance({motion_, around, block}), first_is_mesh, {}});
    return;
  }
  const Around other{second->link, second->pose.translation(), second->radius};
  pairs_.push_back({&first, second, KeptClearance({motion_, around, other}), first_is_mesh, {}});
}

double LinkReplay::sphere_gap(const Pair& pair, const std::vector<Frame>& poses) const {
  const Vec3 centre = centre_of(*pair.first, poses);
  if (pair.second != nullptr)
    return (centre - centre_of(*pair.second, poses)).norm() - pair.first->radius - pair.second->radius;
  const Vec3 local = centre - origin_;
  return (local - local.cwiseMax(0).cwiseMin(material_.side_mm())).norm() - pair.first->radius;
}

bool LinkReplay::near_material(const SolidBody& body, const Frame& link_pose, double grow) const {
  Frame pose = link_pose * body.pose;
  pose.translation() -= origin_;
  const Vec3 half = pose.linear().cwiseAbs() * body.half + Vec3::Constant(grow);
  const Vec3 low = pose.translation() - half, high = pose.translation() + half;
  return any_part(body, grow, [&](const fcl::CollisionGeometryd& part, const Frame& at) {
    return material_.touches(part, pose * at, low, high);
  });
}

bool LinkReplay::near(const Pair& pair, const std::vector<Frame>& poses, double grow) const {
  if (sphere_gap(pair, poses) > grow) return false;
  const Frame& link_pose = poses[static_cast<std::size_t>(pair.first->link)];
  if (pair.second == nullptr) return near_material(*pair.first, link_pose, grow);
  const Frame pose = link_pose * pair.first->pose;
  const Frame other = poses[static_cast<std::size_t>(pair.second->link)] * pair.second->pose;
  const Frame seen = pose.inverse() * other;
  if (fcl::obbDisjoint<double>(seen.linear(), seen.translation(), pair.first->half.array() + grow, pair.second->half))
    return false;
  const auto touches = [&](const fcl::CollisionGeometryd& part, const Frame& at) {
    return any_part(*pair.second, 0, [&](const fcl::CollisionGeometryd& second, const Frame&) {
      return solids_touch(part, pose * at, second, other);
    });
  };
  if (grow == 0 || pair.first->kind != ShapeKind::mesh) return any_part(*pair.first, grow, touches);
  // Both are meshes. FCL fits boxes of its own to each part, which takes ten times as long as to leave it out.
  return pair.first->cover.any_near(pair.second->cover, seen, grow,
                                    [&](const fcl::AABBd& box) { return use_box(box, grow, touches); });
}

bool LinkReplay::unsettled(const Pair& pair, const std::vector<Frame>& poses, const Configuration& steps, double t,
                           const OnContact& on_contact) const {
  const double travel = pair.clearance.bound().at(poses, steps);
  if (!near(pair, poses, travel + contact_slack_mm)) return false;
  const auto& links = cell_.robot.links;
  const std::string names =
      "link " + links[static_cast<std::size_t>(pair.first->link)].name + " and " +
      (pair.second == nullptr ? "the material" : "link " + links[static_cast<std::size_t>(pair.second->link)].name);
  if (near(pair, poses, 0)) {
    on_contact(names + " touch", t);
    return false;
  }
  if (pair.sampled) return 2 * travel > voxel_ / 4;
  if (travel >= too_close_mm) return true;
  on_contact(names + " are too close to prove that they do not touch", t);
  return false;
}

void LinkReplay::certify(const JointMotion& motion, double middle, double half, const std::vector<Pair*>& open,
                         const OnContact& on_contact) const {
  std::vector<Frame> poses;
  motion_.place_links(motion.at(middle), poses);
  std::vector<Pair*> left;
  for (Pair* pair : open)
    if (unsettled(*pair, poses, half * motion.step, middle, on_contact)) left.push_back(pair);
  if (left.empty()) return;
  certify(motion, middle - half / 2, half / 2, left, on_contact);
  certify(motion, middle + half / 2, half / 2, left, on_contact);
}

// Where the motion ended. Worth its cost if it lasts for several motions as long as this one.
void LinkReplay::renew_clearance(Pair& pair, const std::vector<Frame>& poses, const JointMotion& motion) const {
  KeptClearance& kept = pair.clearance;
  kept.move_anchor(motion.to, poses);
  const double travel = kept.approach(motion), gap = sphere_gap(pair, poses);
  if (gap > 0) kept.prove(gap);
  for (double times : {256, 64, 16, 4}) {
    if (kept.proved() >= times * travel) return;
    if (near(pair, poses, times * travel + contact_slack_mm)) continue;
    kept.prove(times * travel);
    return;
  }
}

void LinkReplay::look_ahead(const TrajectoryPiece& piece, bool prove_ahead) {
  for (Pair& pair : pairs_) pair.clearance.forget();
  if (!prove_ahead) {
    ahead_ = OpenItems(piece, pairs_.size());
    return;
  }
  ahead_ = OpenItems(motion_, piece, pairs_.size(),
                     [this](std::size_t at, const OpenItems::Box& box) { return may_touch_in(pairs_[at], box); });
}

bool LinkReplay::may_touch_in(Pair& pair, const OpenItems::Box& box) const {
  const ApproachBound& bound = pair.clearance.bound();
  if (!near(pair, box.poses, bound.at(box.poses, box.half) + contact_slack_mm)) return false;
  const std::vector<MovingJoint>& joints = bound.joints();
  const int coordinate = joints.empty() ? 0 : joints.front().coordinate;
  const bool moved_by_one = std::ranges::all_of(joints, [&](const auto& one) { return one.coordinate == coordinate; });
  if (pair.second == nullptr || !moved_by_one) return true;
  const auto is_free = [&](double middle, double half) {
    Configuration at = Configuration::Zero(box.middle.size()), steps = at;
    at[coordinate] = middle;
    steps[coordinate] = half;
    std::vector<Frame> poses;
    motion_.place_links(at, poses);
    return !near(pair, poses, bound.at(poses, steps) + contact_slack_mm);
  };
  const double middle = box.middle[coordinate], half = box.half[coordinate];
  return !pair.ranges.hold(middle - half, middle + half, is_free);
}

void LinkReplay::replay(std::size_t keyframe, const JointMotion& motion, const OnContact& on_contact) {
  std::vector<Pair*> open;
  for (const std::size_t at : ahead_.of(keyframe))
    if (Pair& pair = pairs_[at]; pair.clearance.bound().moved_by(motion) && !pair.clearance.covers(motion))
      open.push_back(&pair);
  if (open.empty()) return;
  certify(motion, 0.5, 0.5, open, on_contact);
  if (material_.thorough()) return;
  std::vector<Frame> poses;
  motion_.place_links(motion.to, poses);
  for (Pair* pair : open) renew_clearance(*pair, poses, motion);
}

}  // namespace sculpt
