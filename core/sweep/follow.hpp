// Strokes of the ball -> certified keyframes.
#pragma once

#include "core/sweep/posture_field.hpp"
#include "core/sweep/stroke.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// How far the ball's centre may be from a voxel's when it cuts it (voxel edges): the tolerance of sweep trajectories.
inline constexpr double max_ball_deviation = 0.04;

/// How far ball and shank may leave the lines of strokes that pass beside material, in voxel edges.
struct PathTolerance {
  double ball, shank;
};

/// Of a tool that fits through a voxel, less the margin of the certificate.
PathTolerance path_tolerance(const Tool& tool, double voxel_m);

struct FollowedStrokes {
  std::vector<Keyframe> keyframes;  ///< of the strokes that were followed to their end
  std::size_t strokes = 0;          ///< that many; the next one, if any, failed
};

/// Keyframes as far apart as the certificate allows: ball and shank stay within their tolerance of the straight line all
/// along the joint-linear edge, and the links in bubbles of the field. Starts with the ball at `from` (cells of the
/// field's view). Depends on its arguments only; any thread.
FollowedStrokes follow(const PostureField& field, const Tool& tool, const Grid& grid, const Vec3& from,
                const std::vector<Stroke>& strokes);

}  // namespace sculpt
