// Strokes of the ball -> certified keyframes: edges as long as the tolerance allows, each with a bound on how far it is
// off.
//
// The ball is to go 24 voxels straight along a row of 1 mm voxels, within 0.04 voxel of the line. The joints move
// linearly between keyframes, so the ball's path between two of them is an arc:
//
//      from *------------------------------* to     line of the stroke
//            `-..                     ..-'
//                 `` --.._______..-- ``             path of the ball: `off` at the ends, `sagitta` in the middle
//
// Tried first are edges of 8 voxels. In the middle of one the second derivative of the ball's place is 0.096 mm per
// edge^2: a sagitta of 0.096 / 8 = 0.012 voxel. The third derivative, 0.012 mm per edge^3, adds 0.012 / (72 sqrt 3) =
// 0.0001, the ends are off by 0.0005: 0.0126 in all, certified. The sagitta grows with the square of the length, so
// edges along the next row may be about sqrt(0.0375 / 0.0121) = 1.76 times as long to use 0.95 of the tolerance: 14
// voxels. Its 24 are made two edges of 12. If an edge is refused, what was learnt from it makes the next one shorter;
// where a cut of one voxel is refused the strokes end.
#pragma once

#include "core/sweep/field/posture_field.hpp"
#include "core/sweep/stroke.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// How far the ball's centre may be from a voxel's when it cuts it (voxel edges): the tolerance of sweep trajectories.
inline constexpr double max_ball_deviation = 0.04;

/// How far ball and shank may be from the lines of strokes that pass beside material, in voxel edges.
struct PathTolerance {
  double ball, shank;
};

/// What is left of a voxel, to each side, by a tool that passes through it, less the margin of the certificate: with a
/// shank of radius 0.4 voxel 0.095; for the ball not more than `max_ball_deviation`.
PathTolerance path_tolerance(const Tool& tool, double voxel_m);

struct FollowedStrokes {
  std::vector<Keyframe> keyframes;  ///< of the strokes that were followed to their end
  std::size_t strokes = 0;          ///< that many; the next one, if any, failed
};

/// Keyframes as far apart as the certificate allows: ball and shank stay within tolerance of the straight line all
/// along the joint-linear edge, and the links in bubbles of the field. Starts with the ball at `from` (cells of the
/// field's view). Depends on its arguments only; any thread.
FollowedStrokes follow(const PostureField& field, const Tool& tool, const Grid& grid, const Vec3& from,
                       const std::vector<Stroke>& strokes);

}  // namespace sculpt
