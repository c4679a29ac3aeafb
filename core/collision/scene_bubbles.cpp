// Bubbles of a scene: how far each joint may move from a configuration without contact.
#include <algorithm>
#include <cmath>

#include "core/collision/clearance.hpp"
#include "core/collision/scene.hpp"
#include "core/collision/scene_bodies.hpp"

namespace sculpt {
namespace {

/// Pairs that no more joints move are proved free in parts of a box, with that many checks at most.
constexpr Eigen::Index few_joints = 2;
constexpr int max_checks = 200;
constexpr double rounding_m = 1e-9;

/// Of a capsule that moves, per unit of each coordinate: its ends, its turning.
struct CapsuleTwist {
  JointColumns<3> end_a, end_b, turn;
  double radius_m;
};

/// Bound on the second derivative of the capsule's points along any direction in +-half: by two joints it is a turning
/// about the one that comes first, applied to the motion by the other.
double second_order(const CapsuleTwist& twist, const std::vector<Drive>& drives, const Configuration& half) {
  double sum = 0;
  for (std::size_t far = 0; far < drives.size(); ++far) {
    const int j = drives[far].coordinate;
    const Vec3 a = twist.end_a.col(j), b = twist.end_b.col(j);
    const double turning = twist.radius_m * twist.turn.col(j).norm();
    double by_nearer = 0;
    for (std::size_t near = 0; near <= far; ++near) {
      const int i = drives[near].coordinate;
      const Vec3 turn = twist.turn.col(i);
      const double most = std::sqrt(std::max(turn.cross(a).squaredNorm(), turn.cross(b).squaredNorm()));
      by_nearer += (near == far ? 1 : 2) * half[i] * (most + turn.norm() * turning);
    }
    sum += half[j] * by_nearer;
  }
  return sum;
}

}  // namespace

/// At the centre the second derivative is known, so only the third must be bounded. A mimic joint may stand anywhere,
/// so then the second is.
RelativeMotion SceneBodies::motion_of(const Mover& mover, int seen_from, const std::vector<Frame>& at,
                                      const Configuration& half) const {
  const Body& body = bodies[static_cast<std::size_t>(mover.body)];
  const Frame& from = at[static_cast<std::size_t>(seen_from)];
  const Frame& pose = at[static_cast<std::size_t>(body.link)];
  const JointColumns<6> twist = relative_twist(chain, mover.drives, at);
  const auto motion_of = [&](const Vec3& point) {
    JointColumns<3> motion = twist.topRows<3>();
    for (const Drive& drive : mover.drives)
      motion.col(drive.coordinate) =
          twist.col(drive.coordinate).head<3>() + Vec3(twist.col(drive.coordinate).tail<3>()).cross(point);
    return motion;
  };
  const double reach = mover.speed.dot(half);
  const DerivativeBounds derivatives = derivative_bounds(chain, mover.turn.dot(half), reach);
  double remainder = derivatives.second_m / 2;
  if (!has_mimic) {
    const CapsuleTwist hull{motion_of(pose * body.hull.core.a), motion_of(pose * body.hull.core.b),
                            twist.bottomRows<3>(), body.hull.radius_m};
    remainder = std::min(remainder, second_order(hull, mover.drives, half) / 2 + derivatives.third_m / 6);
  }
  const Eigen::Matrix3d turned = from.linear().transpose();
  return {from.inverse() * pose,
          turned * motion_of(from.translation()),
          turned * twist.bottomRows<3>(),
          half,
          reach,
          remainder};
}

bool SceneBodies::is_free_in(const Pair& pair, const JointBox& box, int& checks_left) const {
  if (pair.is_free_between(box.low, box.high)) return true;
  if (checks_left-- <= 0) return false;
  count_check();
  const Configuration centre = box.centre(), half = box.reach_from(centre);
  std::vector<Frame> at;
  chain.link_poses(centre, at);
  if (!near(pair, at, pair.motion(half) + rounding_m + pair.margin_m)) return true;
  if (near(pair, at, pair.margin_m)) return false;
  Eigen::Index widest = 0;
  pair.movers[0].speed.cwiseProduct(half).maxCoeff(&widest);
  JointBox low = box, high = box;
  low.high[widest] = high.low[widest] = centre[widest];
  return is_free_in(pair, low, checks_left) && is_free_in(pair, high, checks_left);
}

Scene::Pairs Scene::pairs() const {
  Pairs all;
  for (std::size_t at = 0; at < bodies_->pairs.size(); ++at)
    if (const SceneBodies::Pair& pair = bodies_->pairs[at]; !pair.tool_and_fixed && !pair.never_touch)
      all.push_back(at);
  return all;
}

Scene::Pairs Scene::pairs_in(const JointBox& box) const {
  Pairs open;
  const JointBox bounded = bodies_->bounded(box);
  if ((bounded.low.array() > bounded.high.array()).any()) return open;
  for (std::size_t at : pairs()) {
    const SceneBodies::Pair& pair = bodies_->pairs[at];
    int checks_left = pair.joints() <= few_joints ? max_checks : 1;
    if (!bodies_->is_free_in(pair, bounded, checks_left)) open.push_back(at);
  }
  return open;
}

Bubble Scene::bubble(const Configuration& q, const JointBox& asked, const std::vector<Configuration>& wanted,
                     const Body& stock, Pairs& pairs) const {
  const JointBox box = bodies_->bounded(asked);
  if (!box.holds(q) || !std::ranges::all_of(wanted, [&](const Configuration& other) { return box.holds(other); }))
    return {};
  bodies_->count_check();
  std::vector<Frame> at;
  bodies_->chain.link_poses(q, at);
  const Configuration half = box.reach_from(q);
  std::vector<Configuration> steps;
  for (const Configuration& other : wanted) steps.emplace_back(other - q);
  std::vector<Bubble::HalfSpace> half_spaces;
  const auto look_at = [&](const SceneBodies::Pair& pair) {
    if (pair.is_free_between(box.low, box.high)) return Nearness::touch_nowhere;
    const double enough = pair.motion(half) + rounding_m;
    const Body& first = bodies_->bodies[static_cast<std::size_t>(pair.first)];
    const Body& second = pair.second < 0 ? stock : bodies_->bodies[static_cast<std::size_t>(pair.second)];
    const auto pose = [&](const Body& body) { return at[static_cast<std::size_t>(body.link)]; };
    if (hull_distance(first, pose(first), second, pose(second)) - pair.margin_m >= enough)
      return Nearness::touch_nowhere;
    const SceneBodies::Mover& mover = pair.mover(half);
    const Body& moves = bodies_->bodies[static_cast<std::size_t>(mover.body)];
    const Body& other = mover.body == pair.first ? second : first;
    RelativeMotion motion = bodies_->motion_of(mover, other.link, at, half);
    motion.reach_m = enough;
    return keep_apart(moves, motion, other, pair.margin_m, steps, half_spaces);
  };
  Pairs left, spoilt;
  for (std::size_t pair : pairs) {
    const Nearness nearness = look_at(bodies_->pairs[pair]);
    if (nearness == Nearness::too_near) spoilt.push_back(pair);
    if (nearness == Nearness::kept_apart) left.push_back(pair);
  }
  // What spoils this box spoils its parts as well, most likely: they shall begin with it.
  pairs = spoilt;
  pairs.insert(pairs.end(), left.begin(), left.end());
  if (!spoilt.empty()) return {};
  return {q, box, std::move(half_spaces)};
}

}  // namespace sculpt
