#include "core/plan/output/path_figures.hpp"

#include <cmath>

namespace sculpt {
namespace {

/// Cosine above which two steps count as one direction (1 degree).
constexpr double straight = 0.99985;

}  // namespace

PathFigures::PathFigures(const Chain& chain, const Grid& grid, const Configuration& home)
    : chain_(chain),
      grid_(grid),
      turning_(Configuration::Zero(chain.dof())),
      q_(home),
      ball_(chain.tool_pose(home).ball_m) {
  for (int c = 0; c < chain.dof(); ++c) {
    const auto joint = static_cast<std::size_t>(chain.joints()[static_cast<std::size_t>(c)]);
    if (chain.robot().joints[joint].kind == JointKind::revolute) turning_[c] = 1;
  }
}

void PathFigures::add(const Keyframe& keyframe) {
  ++keyframes;
  // A cut ends in the middle of a voxel, to within the tolerance of the plan.
  const Vec3 ball = keyframe.cut && !keyframe.mill ? grid_.centre(keyframe.last) : chain_.tool_pose(keyframe.q).ball_m;
  const double length = (ball - ball_).norm();
  (keyframe.cut ? cut_m : travel_m) += length;
  if (length > 0) {
    const Vec3 heading = (ball - ball_) / length;
    if (heading.dot(heading_) < straight) ++turns;
    heading_ = heading;
  }
  joint_travel_rad += turning_.dot((keyframe.q - q_).cwiseAbs());
  if (keyframe.cut && keyframe.mill) {
    removed += static_cast<std::uint64_t>(run_length(keyframe));
    if (!cutting_) ++rows;
  } else if (keyframe.cut) {
    const int count = run_length(keyframe);
    removed += static_cast<std::uint64_t>(count);
    Voxel along = keyframe.first - last_;
    if (count > 1) {
      const Voxel run = keyframe.last - keyframe.first;
      along = {run.i / (count - 1), run.j / (count - 1), run.k / (count - 1)};
    }
    if (!cutting_ || along != along_ || keyframe.first - last_ != along) ++rows;
    along_ = along;
    last_ = keyframe.last;
  } else if (!moving_) {
    ++transits;
  }
  cutting_ = keyframe.cut;
  moving_ = !keyframe.cut;
  q_ = keyframe.q;
  ball_ = ball;
}

}  // namespace sculpt
