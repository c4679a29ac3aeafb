#include "core/material/clamping.hpp"

#include "core/base/error.hpp"

namespace sculpt {
namespace {

std::string text(Voxel v) {
  return std::to_string(v.i) + ", " + std::to_string(v.j) + ", " + std::to_string(v.k);
}

void check_held(const VoxelSet& target, const VoxelSet& left) {
  VoxelSet outside = target;
  outside -= left;
  const std::size_t count = outside.size();
  if (count == 0) return;
  Voxel one{};
  for_each_voxel(outside, [&](Voxel v) { one = v; });
  throw InputError("target_outside_stock",
                   std::to_string(count) + " of " + std::to_string(target.size()) +
                       " voxels of the target are not in what the clamping before left, as it stood there: voxel " +
                       text(one) +
                       " is one. Give the mesh that was carved there, or one inside of it with the "
                       "same scale");
}

Voxel set_down(const CubeTurn& turn, Voxel v, int n, int layers) {
  return turn.of(v, n) - Voxel{0, 0, layers};
}

/// The box around turned voxels is the turned box around them.
Ambiguous clamp_anew(const Ambiguous& before, const CubeTurn& turn, int n, int layers) {
  if (before.voxels == 0) return before;
  const Voxel low = set_down(turn, before.low, n, layers), high = set_down(turn, before.high, n, layers);
  return {before.voxels,
          {std::min(low.i, high.i), std::min(low.j, high.j), std::min(low.k, high.k)},
          {std::max(low.i, high.i), std::max(low.j, high.j), std::max(low.k, high.k)}};
}

}  // namespace

VoxelGrid clamp_anew(const VoxelGrid& before, const VoxelSet& left, const CubeTurn& turn) {
  check_held(before.keep, left);
  const VoxelSet stock = turn.of(left);
  const int layers = lowest_layer(stock);
  return {lowered(stock, layers), lowered(turn.of(before.keep), layers),
          clamp_anew(before.ambiguous, turn, before.n(), layers)};
}

}  // namespace sculpt
