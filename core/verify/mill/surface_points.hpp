// What stands above points of the part's surface, measured on the cutter's ways. Internal to verify/. Millimetres,
// stock frame.
#pragma once

#include <cstdint>
#include <vector>

#include "core/material/voxel_grid.hpp"
#include "core/mesh/mesh.hpp"
#include "core/verify/surface_verdict.hpp"

namespace sculpt {

/// Points at random on the part, with their outward normals. Not shared between threads.
class SurfacePoints {
 public:
  /// `part` in metres. Where both sides of it are well inside of the target there are none.
  SurfacePoints(const Mesh& part, const VoxelGrid& voxels, const Grid& grid);

  /// A ball of `radius` cuts on its middle's way from one place to the other, and strays by up to `stray`.
  void cut(const Vec3& from, const Vec3& to, double radius, double stray);

  /// Above points near which no ball came counts what is in voxels that may hold something, `standing`.
  SurfaceVerdict judge(const VoxelSet& standing) const;

 private:
  struct Point {
    Vec3 at, normal;
    double excess;
  };
  std::size_t box_of(const Vec3& at) const;

  Grid grid_;
  std::vector<Point> points_;  ///< by box
  std::vector<std::uint32_t> begin_;
  Vec3 low_ = Vec3::Zero();
  double edge_ = 1;
  Eigen::Array3i boxes_ = Eigen::Array3i::Zero();
  std::uint64_t gouged_ = 0;
  double deepest_ = 0;
};

}  // namespace sculpt
