#include "core/material/loose_pieces.hpp"

#include <bit>
#include <vector>

#include "core/material/cavities.hpp"
#include "core/material/flood.hpp"

namespace sculpt {
namespace {

/// Erases the voxels of `set` that face-connected paths inside it join to a neighbour of `start`.
void erase_beside(VoxelSet& set, Voxel start, std::vector<Voxel>& stack) {
  const Grid bounds{set.n(), 1, Vec3::Zero()};
  stack.assign(1, start);
  while (!stack.empty()) {
    const Voxel here = stack.back();
    stack.pop_back();
    for (Voxel step : face_steps) {
      const Voxel beside = here + step;
      if (!bounds.contains(beside) || !set.contains(beside)) continue;
      set.erase(beside);
      stack.push_back(beside);
    }
  }
}

}  // namespace

VoxelSet find_loose(const VoxelSet& standing) {
  VoxelSet loose = flood(standing, FloodFrom::floor);
  for (std::size_t at = 0; at < loose.words().size(); ++at)
    loose.words()[at] = standing.words()[at] & ~loose.words()[at];
  return loose;
}

VoxelSet find_unheld(const VoxelGrid& voxels) {
  VoxelSet finished = find_enclosed(voxels);
  for (std::size_t at = 0; at < finished.words().size(); ++at) finished.words()[at] |= voxels.keep.words()[at];
  return find_loose(finished);
}

std::uint64_t count_pieces(const VoxelSet& voxels) {
  VoxelSet rest = voxels;
  const auto n = static_cast<std::size_t>(rest.n());
  std::vector<Voxel> stack;
  std::uint64_t pieces = 0;
  for (std::size_t word = 0; word < rest.words().size(); ++word)
    while (rest.words()[word] != 0) {
      const std::size_t at = 64 * word + static_cast<std::size_t>(std::countr_zero(rest.words()[word]));
      const Voxel start{static_cast<int>(at % n), static_cast<int>(at / n % n), static_cast<int>(at / n / n)};
      rest.erase(start);
      erase_beside(rest, start, stack);
      ++pieces;
    }
  return pieces;
}

}  // namespace sculpt
