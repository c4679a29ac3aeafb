// Strokes of the ball -> certified keyframes.
#pragma once

#include "core/sweep/posture_field.hpp"
#include "core/sweep/stroke.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// How far the ball's centre may be from a voxel's when it cuts it (voxel edges): the tolerance of sweep trajectories.
inline constexpr double most_ball_stray = 0.04;

/// How far ball and shank may leave the lines of strokes that pass beside material, in voxel edges.
struct Stray {
  double ball, shank;
};

/// Of a tool that fits through a voxel, less the margin of the certificate.
Stray stray_of(const Tool& tool, double voxel_m);

struct Followed {
  std::vector<Keyframe> keyframes;  ///< of the strokes that were followed to their end
  std::size_t strokes = 0;          ///< that many; the next one, if any, failed
};

/// Keyframes as far apart as the certificate allows: ball and shank stay within their stray of the straight line all
/// along the joint-linear edge, and the links in bubbles of the field. Starts with the ball at `from` (cells of the
/// field's view). Depends on its arguments only; any thread.
Followed follow(const PostureField& field, const Tool& tool, const Grid& grid, const Vec3& from,
                const std::vector<Stroke>& strokes);

}  // namespace sculpt
