// A straight line of the ball's centre.
#pragma once

#include <algorithm>

#include "core/material/support/support.hpp"

namespace sculpt {

/// Travelling above material keeps a voxel more than needed, so that long edges may leave their line by half a voxel.
inline constexpr double travel_tolerance = 0.5;

inline Vec3 centre(Voxel cell) {
  return {static_cast<double>(cell.i), static_cast<double>(cell.j), static_cast<double>(cell.k)};
}

/// From where the last stroke ended, in cells of a view. A cut goes along one axis and removes the cells it comes to,
/// `count` of them; all others pass through air only.
struct Stroke {
  Vec3 to = Vec3::Zero();
  int count = 0;          ///< 0: nothing is cut
  double tolerance = 0;   ///< how far the tool may leave the line (voxel edges) without coming near any material
  Voxel first{}, last{};  ///< cut: voxels of the grid

  bool cuts() const { return count > 0; }
  VoxelLine line() const { return {first, last}; }
};

/// Voxels number `first` to `last` of a cut that comes from `start`.
inline Stroke part_of(const Stroke& cut, const Vec3& start, int first, int last) {
  const Voxel way = cut.last - cut.first;
  const int steps = std::max(1, cut.count - 1);
  const Voxel step{way.i / steps, way.j / steps, way.k / steps};
  const Vec3 along = (cut.to - start) / cut.count;
  return {start + along * (last + 1), last + 1 - first, cut.tolerance, cut.first + step * first,
          cut.first + step * last};
}

}  // namespace sculpt
