#include "core/material/cube_turn.hpp"

#include <cmath>
#include <numbers>

namespace sculpt {
namespace {

/// A quarter turn about axis 0, 1 or 2, from the one behind it to the one behind that.
Voxel quarter(Voxel v, int axis) {
  switch (axis) {
    case 0:
      return {v.i, -v.k, v.j};
    case 1:
      return {v.k, v.j, -v.i};
    default:
      return {-v.j, v.i, v.k};
  }
}

}  // namespace

Voxel CubeTurn::of(Voxel v, int n) const {
  // In half voxels, so that the middle of the grid has whole coordinates.
  const Voxel middle{n - 1, n - 1, n - 1}, off = v * 2 - middle;
  const Voxel to = axes[0] * off.i + axes[1] * off.j + axes[2] * off.k + middle;
  return {to.i / 2, to.j / 2, to.k / 2};
}

VoxelSet CubeTurn::of(const VoxelSet& set) const {
  if (*this == no_turn) return set;
  VoxelSet to(set.n());
  for_each_voxel(set, [&](Voxel v) { to.insert(of(v, set.n())); });
  return to;
}

std::optional<CubeTurn> cube_turn(const Vec3& rotation_rad) {
  constexpr double tolerance = 1e-6, most = 1000;
  CubeTurn turn = no_turn;
  for (int axis = 0; axis < 3; ++axis) {
    const double quarters = rotation_rad[axis] / (std::numbers::pi / 2), whole = std::round(quarters);
    if (!(std::abs(quarters) <= most) || std::abs(quarters - whole) > tolerance) return std::nullopt;
    const int times = (static_cast<int>(whole) % 4 + 4) % 4;
    for (Voxel& to : turn.axes)
      for (int time = 0; time < times; ++time) to = quarter(to, axis);
  }
  return turn;
}

VoxelSet lowered(const VoxelSet& set, int layers) {
  VoxelSet to(set.n());
  for_each_voxel(set, [&](Voxel v) {
    if (v.k >= layers) to.insert(v - Voxel{0, 0, layers});
  });
  return to;
}

int lowest_layer(const VoxelSet& set) {
  int lowest = set.n();
  for_each_voxel(set, [&](Voxel v) { lowest = std::min(lowest, v.k); });
  return lowest == set.n() ? 0 : lowest;
}

}  // namespace sculpt
