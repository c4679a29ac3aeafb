#include "core/cell/ik.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sculpt {

namespace {

using Rows = Eigen::Matrix<double, 5, 1>;
using Square = Eigen::Matrix<double, 5, 5>;

/// The linear problem at one configuration: three position rows (m) and two axis rows (rad, orthogonal to the axis);
/// unused rows are zero.
struct Linear {
  JointColumns<5> jacobian;
  Rows error = Rows::Zero();
  double position_m = 0, axis_rad = 0;
};

/// One solver run; its vectors are allocated once, no step allocates.
class Solver {
 public:
  Solver(const Chain& chain, const IkGoal& goal, const IkSettings& settings)
      : chain_(chain), goal_(goal), settings_(settings), middle_((chain.lower() + chain.upper()) / 2) {
    linear_.jacobian.setZero(5, chain.dof());
    tried_ = linear_;
    step_.resize(chain.dof());
    pull_.resize(chain.dof());
    held_.resize(static_cast<std::size_t>(chain.dof()));
  }

  std::optional<Configuration> run(Configuration q) {
    hold_in_limits(q);
    linearize(q, linear_);
    Configuration trial = q;
    double damping = start_damping, best = linear_.error.norm();
    for (int step = 0; step < settings_.max_steps; ++step) {
      if (reached()) return q;
      const double before = linear_.error.norm();
      if (!find_step(q, damping)) return std::nullopt;
      trial = q + step_;
      hold_in_limits(trial);
      linearize(trial, tried_);
      if (tried_.error.norm() <= before) {
        damping = std::max(damping / 4, min_damping);
        q.swap(trial);
        std::swap(linear_, tried_);
      } else {
        damping *= 8;
      }
      // From a local minimum no number of steps gets away: better to leave it to another seed.
      if (step % patience == patience - 1) {
        if (linear_.error.norm() > 0.7 * best) return std::nullopt;
        best = linear_.error.norm();
      }
    }
    if (reached()) return q;
    return std::nullopt;
  }

 private:
  static constexpr double start_damping = 1e-3;
  static constexpr double min_damping = 1e-6;
  static constexpr int patience = 12;

  void hold_in_limits(Configuration& q) const {
    if (settings_.respect_limits) q = q.cwiseMax(chain_.lower()).cwiseMin(chain_.upper());
  }

  bool reached() const {
    return linear_.position_m <= settings_.position_tolerance_m && linear_.axis_rad <= settings_.axis_tolerance_rad;
  }

  void linearize(const Configuration& q, Linear& at) {
    const ToolPose pose = chain_.tool_pose(q, full_);
    const Vec3 offset = goal_.ball_m - pose.ball_m;
    at.error.head<3>() = offset;
    at.position_m = offset.norm();
    at.jacobian.topRows<3>() = full_.topRows<3>();
    if (!goal_.axis) return;

    const Vec3 cross = pose.axis.cross(*goal_.axis);
    const double sine = cross.norm();
    at.axis_rad = std::atan2(sine, pose.axis.dot(*goal_.axis));
    const Vec3 u = pose.axis.unitOrthogonal();
    const Vec3 v = pose.axis.cross(u);
    // Where the axes are opposite every turn is as good as any other.
    const Vec3 turn = sine > 1e-12 ? Vec3(cross * (at.axis_rad / sine)) : Vec3(u * at.axis_rad);
    at.error[3] = u.dot(turn);
    at.error[4] = v.dot(turn);
    at.jacobian.row(3).noalias() = u.transpose() * full_.bottomRows<3>();
    at.jacobian.row(4).noalias() = v.transpose() * full_.bottomRows<3>();
  }

  /// Sets `step_`: the damped least-squares step plus the part of the pull that does not move the tool. A joint that
  /// would pass a limit is put on the limit and the others are asked again. False when no joint can move.
  bool find_step(const Configuration& q, double damping) {
    std::fill(held_.begin(), held_.end(), 0);
    const double size = linear_.error.norm();
    // The pull fades with the error, otherwise its second-order effect on the tool would keep the error from reaching
    // zero.
    const double strength = settings_.centring * std::min(1.0, size / 0.05);
    pull_ = strength * (middle_ - q);
    const double lambda = damping * std::min(1.0, size) + 1e-12;
    for (int round = 0; round <= chain_.dof(); ++round) {
      solve_free(lambda);
      cap();
      if (!settings_.respect_limits || !hold_one(q)) break;
    }
    return step_.cwiseAbs().maxCoeff() > 1e-13;
  }

  /// Damped step of the joints that are not held; the held ones keep their entry in `step_`.
  void solve_free(double lambda) {
    Square normal = Square::Identity() * lambda;
    Rows wanted = linear_.error;
    for (int c = 0; c < chain_.dof(); ++c) {
      const Rows column = linear_.jacobian.col(c);
      if (held_[static_cast<std::size_t>(c)]) {
        wanted -= column * step_[c];
      } else {
        wanted -= column * pull_[c];
        normal.noalias() += column * column.transpose();
      }
    }
    const Rows weights = normal.llt().solve(wanted);
    for (int c = 0; c < chain_.dof(); ++c) {
      if (!held_[static_cast<std::size_t>(c)]) step_[c] = pull_[c] + linear_.jacobian.col(c).dot(weights);
    }
  }

  void cap() {
    const double longest = step_.cwiseAbs().maxCoeff();
    if (longest > settings_.max_step_rad) step_ *= settings_.max_step_rad / longest;
  }

  /// Puts the free joint that passes its limit furthest onto the limit. False when none does.
  bool hold_one(const Configuration& q) {
    int worst = -1;
    double excess = 0, allowed = 0;
    for (int c = 0; c < chain_.dof(); ++c) {
      if (held_[static_cast<std::size_t>(c)]) continue;
      const double up = chain_.upper()[c] - q[c], down = chain_.lower()[c] - q[c];
      const double past = std::max(step_[c] - up, down - step_[c]);
      if (past <= excess) continue;
      worst = c;
      excess = past;
      allowed = step_[c] > up ? up : down;
    }
    if (worst < 0) return false;
    held_[static_cast<std::size_t>(worst)] = 1;
    step_[worst] = allowed;
    return true;
  }

  const Chain& chain_;
  const IkGoal& goal_;
  const IkSettings& settings_;
  Configuration middle_;
  Linear linear_, tried_;  ///< at the configuration, and where the last step would lead
  JointColumns<6> full_;
  Configuration step_, pull_;
  std::vector<char> held_;
};

}  // namespace

std::optional<Configuration> solve_ik(const Chain& chain, const IkGoal& goal, const Configuration& seed,
                                      const IkSettings& settings) {
  return Solver(chain, goal, settings).run(seed);
}

}  // namespace sculpt
