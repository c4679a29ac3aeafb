// What stands above points of the part's surface, measured on the cutter's ways. Internal to verify/. Millimetres,
// stock frame.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/material/voxel_grid.hpp"
#include "core/mesh/mesh.hpp"
#include "core/verify/findings/surface_verdict.hpp"

namespace sculpt {

/// A point of the part's surface and its outward normal, a unit vector.
struct SurfacePoint {
  Vec3 at, normal;
  bool is_base = false;  ///< of the face that the part stands on
};

/// Those at random on the part (metres), where not both sides of it are well inside of the target.
std::vector<SurfacePoint> draw_points(const Mesh& part, const VoxelGrid& voxels, const Grid& grid);

/// The normal, or its opposite where the target is before it and not behind; nothing where it is well inside.
std::optional<Vec3> outward(const Vec3& at, const Vec3& normal, const VoxelGrid& voxels, const Grid& grid);

/// Not shared between threads.
class SurfacePoints {
 public:
  /// Balls that pass a point at more than `near_mm` count as not near it; a larger excess is that of the voxels.
  SurfacePoints(const std::vector<SurfacePoint>& points, const Grid& grid, double near_mm = 1);

  /// A ball of `radius` cuts on its middle's way from one place to the other, and strays by up to `stray`.
  void cut(const Vec3& from, const Vec3& to, double radius, double stray);

  /// In the order of the points, but for those of the base. Above those near which no ball came counts what is in
  /// voxels that may hold something, `standing`.
  SurfaceVerdict judge(const VoxelSet& standing) const;

 private:
  struct Point {
    Vec3 at, normal;
    double excess;
    bool is_base;
    std::size_t number;  ///< as they were given
  };
  std::size_t box_of(const Vec3& at) const;
  void cut(Point& point, const Vec3& from, const Vec3& way, double radius, double stray);

  Grid grid_;
  double near_mm_;
  std::vector<Point> points_;  ///< by box
  std::vector<std::uint32_t> begin_;
  Vec3 low_ = Vec3::Zero();
  double edge_ = 1;
  Eigen::Array3i boxes_ = Eigen::Array3i::Zero();
  std::uint64_t gouged_ = 0;
  double deepest_ = 0;
};

}  // namespace sculpt
