#include "core/sweep/field/posture.hpp"

#include "core/trajectory/quantum.hpp"

namespace sculpt {
namespace {

constexpr int max_steps = 8;
constexpr double enough_m = 2e-9, enough_rad = 2e-8;
constexpr double max_step = 0.3;  // rad or m; a longer one means that the guess was not close

}  // namespace

std::optional<Configuration> find_posture(const Chain& chain, const Vec3& ball_m, const Vec3& axis,
                                          const Configuration& guess) {
  const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
  JointColumns<6> full;
  JointColumns<5> jacobian(5, chain.dof());
  Configuration q = guess;
  for (int step = 0; step < max_steps; ++step) {
    const ToolPose pose = chain.tool_pose(q, full);
    const Vec3 turn = pose.axis.cross(axis);
    Eigen::Matrix<double, 5, 1> error;
    error << ball_m - pose.ball_m, u.dot(turn), v.dot(turn);
    if (pose.axis.dot(axis) > 0 && error.head<3>().norm() < enough_m && error.tail<2>().norm() < enough_rad) {
      q = rounded(q);
      if (chain.within_limits(q)) return q;
      return std::nullopt;
    }
    jacobian.topRows<3>() = full.topRows<3>();
    jacobian.row(3).noalias() = u.transpose() * full.bottomRows<3>();
    jacobian.row(4).noalias() = v.transpose() * full.bottomRows<3>();
    Eigen::Matrix<double, 5, 5> normal = jacobian * jacobian.transpose();
    normal.diagonal().array() += 1e-12;
    Configuration change = Configuration::Zero(chain.dof());
    change.noalias() += jacobian.transpose() * normal.llt().solve(error);
    if (!(change.cwiseAbs().maxCoeff() < max_step)) return std::nullopt;
    q += change;
  }
  return std::nullopt;
}

}  // namespace sculpt
