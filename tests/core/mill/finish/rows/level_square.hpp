// A level square with balls at rest on it.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "core/mill/finish/rows/plan_patch.hpp"
#include "tests/core/mill/finish/quads.hpp"

namespace sculpt {

struct LevelSquare {
  static constexpr double edge = 0.032, radius = 3e-3;

  PartInGrid square =
      in_grid(quads({{Vec3(0, 0, 0.016), Vec3(edge, 0, 0.016), Vec3(edge, edge, 0.016), Vec3(0, edge, 0.016)}}), edge,
              [](const Voxel& voxel) { return voxel.k < 16; });
  Nails nails{square.mesh, square.voxels, square.grid, 4000, 3};
  ToolFrame frame{{0, 0, 1}};

  /// On those of its nails that are meant.
  std::vector<RestingBall> balls(const std::function<bool(const Vec3&)>& is_meant) const {
    std::vector<RestingBall> found;
    for (std::uint32_t nail = 0; nail < nails.size(); ++nail)
      if (is_meant(nails[nail].point))
        found.push_back({nail, frame.of(nails[nail].point + radius * nails[nail].normal), false});
    return found;
  }
};

/// In plan, from a place to the nearest of some curves.
inline double away_from(const std::vector<std::vector<Point2>>& curves, const Point2& at) {
  double least = 1;
  for (const auto& curve : curves)
    for (std::size_t corner = 0; corner + 1 < curve.size(); ++corner) {
      const Point2 way = curve[corner + 1] - curve[corner];
      const double length2 = way.squaredNorm(),
                   share = length2 > 0 ? std::clamp((at - curve[corner]).dot(way) / length2, 0.0, 1.0) : 0;
      least = std::min(least, (at - curve[corner] - share * way).norm());
    }
  return least;
}

inline double length_of(const std::vector<std::vector<Point2>>& curves) {
  double length = 0;
  for (const auto& curve : curves)
    for (std::size_t corner = 0; corner + 1 < curve.size(); ++corner)
      length += (curve[corner + 1] - curve[corner]).norm();
  return length;
}

}  // namespace sculpt
