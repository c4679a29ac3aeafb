#include "core/plan/path_figures.hpp"

#include <cmath>

namespace sculpt {
namespace {

/// Cosine above which two steps count as one direction (1 degree).
constexpr double straight = 0.99985;

}  // namespace

void PathFigures::add(const Keyframe& keyframe) {
  ++keyframes;
  const Vec3 ball = chain_.tool_pose(keyframe.q).ball_m;
  const double length = (ball - ball_).norm();
  (keyframe.cut ? cut_m : travel_m) += length;
  if (length > 0) {
    const Vec3 heading = (ball - ball_) / length;
    if (heading.dot(heading_) < straight) ++turns;
    heading_ = heading;
  }
  for (int c = 0; c < chain_.dof(); ++c)
    if (chain_.robot().joints[static_cast<std::size_t>(chain_.joints()[static_cast<std::size_t>(c)])].kind ==
        JointKind::revolute)
      joint_travel_rad += std::abs(keyframe.q[c] - q_[c]);
  if (keyframe.cut) {
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
