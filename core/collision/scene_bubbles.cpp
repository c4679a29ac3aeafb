#include <algorithm>
#include <array>
#include <cmath>

#include "core/collision/clearance.hpp"
#include "core/collision/scene_impl.hpp"

namespace sculpt {
namespace {

/// Pairs that no more joints move are proved free in parts of a box, with that many checks at most.
constexpr Eigen::Index few_joints = 2;
constexpr int most_checks = 200;

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

/// A distance (m) that the two are surely apart beyond their margin, looked for as far as `enough`; 0 if they may be
/// nearer than the shortest one tried. FCL is asked only where the closed form says little.
double Scene::Impl::gap(const Pair& pair, const std::vector<Frame>& at, double enough) const {
  static constexpr std::array reaches{0.001, 0.002, 0.004, 0.008, 0.012, 0.018, 0.025, 0.035};
  const Body& a = bodies[static_cast<std::size_t>(pair.first)];
  const Frame& pose_a = at[static_cast<std::size_t>(a.link)];
  double apart = 0;
  if (pair.second < 0) {
    apart = least_distance_to_grid(a, pose_a, grid);
  } else {
    const Body& b = bodies[static_cast<std::size_t>(pair.second)];
    apart = least_distance(a, pose_a, b, at[static_cast<std::size_t>(b.link)], enough + pair.margin_m);
  }
  apart = std::max(0.0, apart - pair.margin_m);
  auto reach = std::upper_bound(reaches.begin(), reaches.end(), apart);
  while (apart < enough && reach != reaches.end() && !near(pair, at, *reach + pair.margin_m)) apart = *reach++;
  return apart;
}

/// The body that moves less, as it approaches the other. Its second derivative is exact at the centre; a mimic joint
/// may stand anywhere, so then only a bound is known. The third derivative is bounded.
Bubble::Approach Scene::Impl::approach(const Pair& pair, const std::vector<Frame>& at, const Configuration& half,
                                       double gap_m) const {
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
  Bubble::Approach approach{motion_of(pose * body.hull.core.a), motion_of(pose * body.hull.core.b),
                            twist.bottomRows<3>(), body.hull.radius_m, gap_m};
  const DerivativeBounds bounds = derivative_bounds(chain, mover.turn.dot(half), mover.speed.dot(half));
  double rest = bounds.second_m / 2;
  if (!has_mimic) rest = std::min(rest, second_order(approach, mover.drives, half) / 2 + bounds.third_m / 6);
  approach.room_m -= rest;
  return approach;
}

bool Scene::Impl::is_free_in(const Pair& pair, const JointBox& box, int& checks_left) const {
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
  for (std::size_t at = 0; at < impl_->pairs.size(); ++at)
    if (const Impl::Pair& pair = impl_->pairs[at]; !pair.tool_and_fixed && !pair.never_touch) all.push_back(at);
  return all;
}

Scene::Pairs Scene::pairs_in(const JointBox& box) const {
  Pairs open;
  for (std::size_t at : pairs()) {
    const Impl::Pair& pair = impl_->pairs[at];
    int checks_left = pair.joints() <= few_joints ? most_checks : 1;
    if (!impl_->is_free_in(pair, box, checks_left)) open.push_back(at);
  }
  return open;
}

Bubble Scene::bubble(const Configuration& q, const JointBox& box, Pairs& pairs) const {
  impl_->count_check();
  std::vector<Frame> at;
  impl_->chain.link_poses(q, at);
  const Configuration half = box.reach_from(q);
  std::vector<Bubble::Approach> approaches;
  const auto is_open = [&](std::size_t which) {
    const Impl::Pair& pair = impl_->pairs[which];
    const double enough = pair.motion(half) + 1e-9;
    const double apart = impl_->gap(pair, at, enough);
    if (apart >= enough) return false;
    approaches.push_back(impl_->approach(pair, at, half, apart));
    return true;
  };
  auto kept = pairs.begin();
  for (auto pair = pairs.begin(); pair != pairs.end(); ++pair) {
    if (!is_open(*pair)) continue;
    if (approaches.back().room_m <= 0) {
      // What spoils this box spoils its parts as well, most likely: they shall begin with it.
      std::rotate(pairs.begin(), pair, pair + 1);
      pairs.erase(kept + 1, pair + 1);
      return {};
    }
    *kept++ = *pair;
  }
  pairs.erase(kept, pairs.end());
  return {q, box, approaches};
}

}  // namespace sculpt
