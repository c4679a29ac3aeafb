// A tool over what stands anywhere in a grid.
#pragma once

#include <vector>

#include "core/base/random.hpp"
#include "core/mill/map/site.hpp"
#include "tests/core/material/shapes.hpp"

namespace sculpt {

/// Of voxels of 1 mm, fewer towards the top; seen along some direction. The part is far below, and nothing is above
/// the cutter.
class RubbleSite {
 public:
  RubbleSite(Random& random, const Cutter& cutter, const Direction& direction)
      : cutter_(cutter), site_(make_site(direction)) {
    VoxelSet standing(n);
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          if (random.between(0, 1) < 0.4 / (1 + k)) standing.insert({i, j, k});
    Grid grid;
    grid.n = n;
    grid.voxel_m = voxel_m;
    grid.origin_m = Vec3::Zero();
    site_.see(standing, grid, Helpers(1));
    for_each_voxel(standing, [&](const Voxel& voxel) { add_points(voxel); });
  }

  const Site& site() const { return site_; }
  /// From the cutter with its tip there, and all above it, to the nearest corner, middle of an edge or a face, or
  /// centre of a voxel that stands (m); negative where one is inside.
  double room_m(const Vec3& tip) const {
    double room = 1;
    for (const Vec3& point : points_) room = std::min(room, room_to(point - tip));
    return room;
  }

  Vec3 some_place(Random& random) const {
    return site_.frame().of(voxel_m * n * Vec3(random.between(0, 1), random.between(0, 1), random.between(0, 1)));
  }

  static constexpr int n = 32;
  static constexpr double voxel_m = 1e-3;

 private:
  void add_points(const Voxel& voxel) {
    for (const double i : {0.0, 0.5, 1.0})
      for (const double j : {0.0, 0.5, 1.0})
        for (const double k : {0.0, 0.5, 1.0})
          points_.push_back(site_.frame().of(voxel_m * Vec3(voxel.i + i, voxel.j + j, voxel.k + k)));
  }

  Site make_site(const Direction& direction) const {
    const ToolFrame frame(direction);
    Assembly assembly;
    assembly.tool.cutter = cutter_;
    const Vec3 low = Vec3::Zero(), high = Vec3::Constant(n * voxel_m), below = -0.1 * frame.w;
    return {frame,    lattice_over(frame, low, high, 0.01, 7e-4),
            assembly, shapes::box(below, below + Vec3::Constant(1e-3)),
            {},       {0, 1e-4}};
  }

  /// Of a ball or a flat cutter, and a rod above it.
  double room_to(const Vec3& off) const {
    const double out = off.head<2>().norm() - cutter_.radius_m, corner = cutter_.corner_radius_m;
    if (corner > 0 && off.z() < corner) return std::hypot(off.head<2>().norm(), off.z() - corner) - corner;
    return out > 0 && off.z() < 0 ? std::hypot(out, off.z()) : std::max(out, -off.z());
  }

  Cutter cutter_;
  Site site_;
  std::vector<Vec3> points_;  ///< tool frame
};

/// A ball, or a flat one.
inline Cutter some_cutter(Random& random, bool is_ball) {
  const double radius = random.between(1e-3, 4e-3);
  return {is_ball ? CutterKind::ball : CutterKind::flat, radius, is_ball ? radius : 0, 0.03};
}

}  // namespace sculpt
