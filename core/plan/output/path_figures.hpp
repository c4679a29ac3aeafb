// Keyframes -> the path figures of the report.
#pragma once

#include "core/cell/chain.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// Counts as keyframes pass by. A row is a straight run of cuts one voxel after the other, a transit an unbroken series
/// of moves; lengths are chords of the ball's path between keyframes (m), joint travel sums over revolute joints (rad).
/// A turn is a change of the ball's direction by more than a degree.
class PathFigures {
 public:
  PathFigures(const Chain& chain, const Grid& grid, const Configuration& home);

  void add(const Keyframe& keyframe);

  std::uint64_t keyframes = 0, rows = 0, transits = 0, removed = 0, turns = 0;
  double cut_m = 0, travel_m = 0, joint_travel_rad = 0;

 private:
  const Chain& chain_;
  Grid grid_;
  Configuration turning_;  ///< 1 for revolute joints, else 0
  Configuration q_;
  Vec3 ball_;
  bool cutting_ = false, moving_ = false;
  Voxel last_, along_;
  Vec3 heading_ = Vec3::Zero();
};

}  // namespace sculpt
