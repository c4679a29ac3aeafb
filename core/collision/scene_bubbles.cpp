// Bubbles of a scene: how far each joint may move from a configuration without contact.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/collision/clearance.hpp"
#include "core/collision/scene.hpp"
#include "core/collision/scene_bodies.hpp"

namespace sculpt {
namespace {

/// Pairs that no more joints move are proved free in parts of a box, with that many checks at most.
constexpr Eigen::Index few_joints = 2;
constexpr int max_checks = 200;

/// Bound on the second derivative of the capsule's points along any direction in +-half: by two joints it is a turning
/// about the one that comes first, applied to the motion by the other.
double second_order(const Bubble::Approach& approach, const std::vector<Drive>& drives, const Configuration& half) {
  double sum = 0;
  for (std::size_t far = 0; far < drives.size(); ++far) {
    const int j = drives[far].coordinate;
    const Vec3 a = approach.end_a.col(j), b = approach.end_b.col(j);
    const double turning = approach.radius_m * approach.turn.col(j).norm();
    double by_nearer = 0;
    for (std::size_t near = 0; near <= far; ++near) {
      const int i = drives[near].coordinate;
      const Vec3 turn = approach.turn.col(i);
      const double most = std::sqrt(std::max(turn.cross(a).squaredNorm(), turn.cross(b).squaredNorm()));
      by_nearer += (near == far ? 1 : 2) * half[i] * (most + turn.norm() * turning);
    }
    sum += half[j] * by_nearer;
  }
  return sum;
}

}  // namespace

/// A distance (m) that the two are surely apart beyond their margin, in closed form; looks no closer once it is
/// `enough`.
double SceneBodies::plain_gap(const Pair& pair, const std::vector<Frame>& at, double enough) const {
  const Body& a = bodies[static_cast<std::size_t>(pair.first)];
  const Frame& pose_a = at[static_cast<std::size_t>(a.link)];
  double apart = 0;
  if (pair.second < 0) {
    apart = least_distance_to_grid(a, pose_a, grid);
  } else {
    const Body& b = bodies[static_cast<std::size_t>(pair.second)];
    apart = least_distance(a, pose_a, b, at[static_cast<std::size_t>(b.link)], enough + pair.margin_m);
  }
  return std::max(0.0, apart - pair.margin_m);
}

/// The same, but asks FCL where the closed form says little, as far as `enough`; 0 if they may be nearer than the
/// shortest distance tried.
double SceneBodies::gap(const Pair& pair, const std::vector<Frame>& at, double enough) const {
  static constexpr std::array reaches{0.001, 0.002, 0.004, 0.008, 0.012, 0.018, 0.025, 0.035};
  double apart = plain_gap(pair, at, enough);
  auto reach = std::upper_bound(reaches.begin(), reaches.end(), apart);
  while (apart < enough && reach != reaches.end() && !near(pair, at, *reach + pair.margin_m)) apart = *reach++;
  return apart;
}

/// The body that moves less, as it approaches the other. The room lacks the distance, and what a bound on the second
/// derivative takes off.
Bubble::Approach SceneBodies::approach(const Pair& pair, const std::vector<Frame>& at,
                                       const Configuration& half) const {
  const Mover& mover = pair.mover(half);
  const Body& body = bodies[static_cast<std::size_t>(mover.body)];
  const auto twist = relative_twist(chain, mover.drives, at);
  const Frame& pose = at[static_cast<std::size_t>(body.link)];
  const auto motion_of = [&](const Vec3& point) {
    JointColumns<3> motion = twist.topRows<3>();
    for (const Drive& drive : mover.drives)
      motion.col(drive.coordinate) =
          twist.col(drive.coordinate).head<3>() + Vec3(twist.col(drive.coordinate).tail<3>()).cross(point);
    return motion;
  };
  return {motion_of(pose * body.hull.core.a), motion_of(pose * body.hull.core.b), twist.bottomRows<3>(),
          body.hull.radius_m, -derivative_bounds(chain, mover.turn.dot(half), mover.speed.dot(half)).second_m / 2};
}

/// Takes off less: at the centre the second derivative is known. A mimic joint may stand anywhere, so then only the
/// bound is.
void SceneBodies::sharpen(Bubble::Approach& approach, const Pair& pair, const Configuration& half) const {
  if (has_mimic) return;
  const Mover& mover = pair.mover(half);
  const double third = derivative_bounds(chain, mover.turn.dot(half), mover.speed.dot(half)).third_m;
  approach.room_m = std::max(approach.room_m, -second_order(approach, mover.drives, half) / 2 - third / 6);
}

/// Planes between the body that moves less and all of the other, of pieces that may come too near within +-half at all.
std::optional<std::vector<Separation>> SceneBodies::planes(const Pair& pair, const std::vector<Frame>& at,
                                                           const Configuration& half, double enough) const {
  const int which = pair.mover(half).body;
  const Body& body = bodies[static_cast<std::size_t>(which)];
  const Frame& pose = at[static_cast<std::size_t>(body.link)];
  if (pair.second < 0) return separations_from_grid(body, pose, grid, enough + pair.margin_m);
  const Body& other = bodies[static_cast<std::size_t>(which == pair.first ? pair.second : pair.first)];
  return separations(body, pose, other, at[static_cast<std::size_t>(other.link)], enough + pair.margin_m);
}

/// How the body comes nearer to those of the planes that it may come too near to. Nothing if it has no room at one.
std::optional<std::vector<Bubble::Advance>> SceneBodies::advances(const std::vector<Separation>& planes,
                                                                  const Bubble::Approach& approach, const Pair& pair,
                                                                  const std::vector<Frame>& at,
                                                                  const Configuration& half) const {
  const Body& body = bodies[static_cast<std::size_t>(pair.mover(half).body)];
  const Vec3 hull_a = at[static_cast<std::size_t>(body.link)] * body.hull.core.a;
  std::vector<Bubble::Advance> advances;
  for (const Separation& plane : planes) {
    const double room = plane.gap_m - pair.margin_m + approach.room_m;
    if (room <= 0) return std::nullopt;
    const Vec3 lever_a = (plane.capsule.core.a - hull_a).cross(plane.normal);
    const Vec3 lever_b = (plane.capsule.core.b - hull_a).cross(plane.normal);
    Bubble::Advance advance{Configuration(half.size()), Configuration(half.size()), room};
    double max_a = 0, max_b = 0;
    for (Eigen::Index joint = 0; joint < half.size(); ++joint) {
      const Vec3 turn = approach.turn.col(joint);
      const double shared = plane.normal.dot(approach.end_a.col(joint));
      advance.end_a[joint] = -(shared + turn.dot(lever_a));
      advance.end_b[joint] = -(shared + turn.dot(lever_b));
      max_a += std::abs(advance.end_a[joint]) * half[joint];
      max_b += std::abs(advance.end_b[joint]) * half[joint];
    }
    if (std::max(max_a, max_b) >= room) advances.push_back(advance);
  }
  return advances;
}

bool SceneBodies::is_free_in(const Pair& pair, const JointBox& box, int& checks_left) const {
  if (pair.is_free_between(box.low, box.high)) return true;
  if (checks_left-- <= 0) return false;
  count_check();
  const Configuration centre = box.centre(), half = box.reach_from(centre);
  std::vector<Frame> at;
  chain.link_poses(centre, at);
  const double enough = pair.motion(half) + 1e-9;
  const double apart = gap(pair, at, enough);
  if (apart >= enough) return true;
  if (apart == 0) return false;
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

Bubble Scene::bubble(const Configuration& q, const JointBox& wanted, Pairs& pairs) const {
  const JointBox box = bodies_->bounded(wanted);
  if (!box.holds(q)) return {};
  bodies_->count_check();
  std::vector<Frame> at;
  bodies_->chain.link_poses(q, at);
  const Configuration half = box.reach_from(q);
  std::vector<Bubble::Approach> approaches;
  std::vector<Bubble::Advance> advances;
  enum class Answer { touch_nowhere, kept_apart, too_near };
  const auto look_at = [&](const SceneBodies::Pair& pair) {
    if (pair.is_free_between(box.low, box.high)) return Answer::touch_nowhere;
    const double enough = pair.motion(half) + 1e-9;
    const auto planes = bodies_->planes(pair, at, half, enough);
    if (planes && planes->empty()) return Answer::touch_nowhere;
    Bubble::Approach approach = bodies_->approach(pair, at, half);
    const auto advances_to = [&](const std::vector<Separation>& all) {
      return bodies_->advances(all, approach, pair, at, half);
    };
    if (planes) {
      if (const auto rough = advances_to(*planes); rough && rough->empty()) return Answer::touch_nowhere;
    }
    bodies_->sharpen(approach, pair, half);
    if (planes) {
      if (const auto sharp = advances_to(*planes)) {
        advances.insert(advances.end(), sharp->begin(), sharp->end());
        return sharp->empty() ? Answer::touch_nowhere : Answer::kept_apart;
      }
    }
    const double apart = bodies_->gap(pair, at, enough);
    if (apart >= enough) return Answer::touch_nowhere;
    approach.room_m += apart;
    if (approach.room_m <= 0) return Answer::too_near;
    approaches.push_back(approach);
    return Answer::kept_apart;
  };
  Pairs left, spoilt;
  for (std::size_t pair : pairs) {
    const Answer answer = look_at(bodies_->pairs[pair]);
    if (answer == Answer::too_near) spoilt.push_back(pair);
    if (answer == Answer::kept_apart) left.push_back(pair);
  }
  // What spoils this box spoils its parts as well, most likely: they shall begin with it.
  pairs = spoilt;
  pairs.insert(pairs.end(), left.begin(), left.end());
  if (!spoilt.empty()) return {};
  return {q, box, approaches, std::move(advances)};
}

}  // namespace sculpt
