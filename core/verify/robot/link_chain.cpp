#include "core/verify/robot/link_chain.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {

struct LinkChain::Drive {
  Vec3 spin = Vec3::Zero(), spin_rate = Vec3::Zero();   // of the link
  Vec3 at = Vec3::Zero(), acceleration = Vec3::Zero();  // of a point of it

  Vec3 acceleration_of(const Vec3& point) const {
    const Vec3 arm = point - at;
    return acceleration + spin_rate.cross(arm) + spin.cross(spin.cross(arm));
  }
};

void LinkChain::place(const Configuration& q, Place& place) const {
  place.axes.resize(hops_.size());
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec3 at = Vec3::Zero();
  for (std::size_t joint = 0; joint < hops_.size(); ++joint) {
    const Hop& hop = hops_[joint];
    at += turn * hop.before.translation();
    turn = turn * hop.before.linear();
    const Vec3 x = turn.col(0), y = turn.col(1), z = turn.col(2);
    place.axes[joint] = {at, z};
    const double value = hop.rate * q[hop.coordinate] + hop.constant;
    if (hop.turns) {
      const double c = std::cos(value), s = std::sin(value);
      turn.col(0) = c * x + s * y;
      turn.col(1) = c * y - s * x;
    } else {
      at += value * z;
    }
  }
  place.link.translation() = at + turn * after_.translation();
  place.link.linear() = turn * after_.linear();
}

// Joint rates are constant over the motion. A joint that turns adds its spin to that of all nearer ones, which also
// turn its axis; one that shifts has its way turned by them.
LinkChain::Drive LinkChain::drive(const Place& place, const Configuration& step) const {
  Drive drive;
  for (std::size_t joint = 0; joint < hops_.size(); ++joint) {
    const auto& [at, way] = place.axes[joint];
    const Vec3 rate = hops_[joint].rate * step[hops_[joint].coordinate] * way;
    drive.acceleration = drive.acceleration_of(at);
    drive.at = at;
    if (hops_[joint].turns) {
      drive.spin_rate += drive.spin.cross(rate);
      drive.spin += rate;
    } else {
      drive.acceleration += 2 * drive.spin.cross(rate);
    }
  }
  return drive;
}

// Each derivative by a joint that turns is a turn of what the farther ones give, so that the n-th one by n joints is at
// most the product of their rates and the distance from the axis of the farthest of them: over all choices of n, with
// S_k the sum of rates up to the k-th joint, (S_k^n - S_(k-1)^n) times that distance. A joint that shifts has only a
// first derivative, in n places among those of nearer ones.
double LinkChain::fourth_derivative(const Place& place, const Configuration& step, const Vec3& a, const Vec3& b) const {
  const auto fourth_power = [](double x) { return x * x * x * x; };
  double moved = 0, turning = 0, bound = 0;
  for (std::size_t joint = hops_.size(); joint-- > 0;)
    if (hops_[joint].turns) turning += std::abs(hops_[joint].rate * step[hops_[joint].coordinate]);
  for (std::size_t joint = hops_.size(); joint-- > 0;) {
    const Hop& hop = hops_[joint];
    const double rate = std::abs(hop.rate * step[hop.coordinate]);
    if (rate == 0) continue;
    if (!hop.turns) {
      bound += 4 * turning * turning * turning * rate;
      moved += rate;
      continue;
    }
    // Where the joint is on its way the point may be nearer or farther by what the farther joints move it.
    const auto& [at, way] = place.axes[joint];
    const double arm = std::sqrt(std::max(way.cross(a - at).squaredNorm(), way.cross(b - at).squaredNorm())) + moved;
    const double nearer = std::max(0.0, turning - rate);
    bound += (fourth_power(turning) - fourth_power(nearer)) * arm;
    turning = nearer;
    moved += rate * arm;
  }
  return bound;
}

// The acceleration strays from the straight line between its two ends by at most an eighth of its own second
// derivative, and a point strays from the straight way by at most an eighth of the largest acceleration.
double LinkChain::sagitta(const Place& start, const Place& end, const Configuration& step, const Vec3& a,
                          const Vec3& b) const {
  const Drive first = drive(start, step), last = drive(end, step);
  const Vec3 a_there = end.link * a, b_there = end.link * b;
  const double largest =
      std::max({first.acceleration_of(start.link * a).norm(), first.acceleration_of(start.link * b).norm(),
                last.acceleration_of(a_there).norm(), last.acceleration_of(b_there).norm()});
  return (largest + fourth_derivative(end, step, a_there, b_there) / 8) / 8;
}

bool LinkChain::moved_by(const Configuration& step) const {
  return std::ranges::any_of(hops_, [&](const Hop& hop) { return step[hop.coordinate] != 0; });
}

}  // namespace sculpt
