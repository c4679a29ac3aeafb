// Integer voxel coordinates and the grid that places them in the stock frame.
#pragma once

#include <array>
#include <compare>
#include <cstdlib>

#include "core/base/frame.hpp"

namespace sculpt {

struct Voxel {
  int i = 0, j = 0, k = 0;
  auto operator<=>(const Voxel&) const = default;  // NOLINT(modernize-use-nullptr): what 14 says of it is wrong
  Voxel operator+(Voxel o) const { return {i + o.i, j + o.j, k + o.k}; }
  Voxel operator-(Voxel o) const { return {i - o.i, j - o.j, k - o.k}; }
  Voxel operator*(int s) const { return {i * s, j * s, k * s}; }
};

/// The six face directions: -x +x -y +y -z +z.
inline constexpr std::array<Voxel, 6> face_steps{{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

constexpr int sign(int x) {
  return (x > 0) - (x < 0);
}
/// Of each coordinate: of a way along one axis the step.
constexpr Voxel sign(Voxel way) {
  return {sign(way.i), sign(way.j), sign(way.k)};
}

inline int l1(Voxel a, Voxel b) {
  return std::abs(a.i - b.i) + std::abs(a.j - b.j) + std::abs(a.k - b.k);
}

/// Voxels in a straight line along one axis, removed one after the other from `first` to `last`.
struct VoxelLine {
  Voxel first, last;
};

/// A cube of n x n x n voxels of edge `voxel_m`; `origin_m` is the corner of voxel (0,0,0), all in the stock frame.
struct Grid {
  int n = 0;
  double voxel_m = 0;
  Vec3 origin_m = Vec3::Zero();

  Vec3 centre(Voxel v) const { return origin_m + voxel_m * Vec3(v.i + 0.5, v.j + 0.5, v.k + 0.5); }
  bool contains(Voxel v) const { return v.i >= 0 && v.j >= 0 && v.k >= 0 && v.i < n && v.j < n && v.k < n; }
};

}  // namespace sculpt
