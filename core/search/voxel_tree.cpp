#include "core/search/voxel_tree.hpp"

#include <algorithm>
#include <bit>

namespace sculpt {
namespace {

int outside(int at, int low, int size) {
  return std::max({low - at, at - (low + size - 1), 0});
}

/// L1 to the nearest voxel of a cube.
int distance_to_cube(Voxel from, Voxel corner, int size) {
  return outside(from.i, corner.i, size) + outside(from.j, corner.j, size) + outside(from.k, corner.k, size);
}

}  // namespace

VoxelTree::VoxelTree(int n) : log_n_(std::countr_zero(static_cast<unsigned>(n))) {
  for (int edge = n / 2; edge > 0; edge /= 2) parts_.emplace_back(static_cast<std::size_t>(edge) * edge * edge);
}

void VoxelTree::insert(Voxel v) {
  for (int level = 0; level < log_n_; ++level) {
    std::uint8_t& parts = parts_[level][cube(v, level)];
    const bool known = parts != 0;
    parts |= static_cast<std::uint8_t>(1 << part(v, level));
    if (known) return;
  }
}

void VoxelTree::erase(Voxel v) {
  for (int level = 0; level < log_n_; ++level) {
    std::uint8_t& parts = parts_[level][cube(v, level)];
    parts &= static_cast<std::uint8_t>(~(1 << part(v, level)));
    if (parts != 0) return;
  }
}

int VoxelTree::distance(Voxel from, int most) const {
  visit({0, 0, 0}, log_n_ - 1, from, most);
  return most;
}

void VoxelTree::visit(Voxel corner, int level, Voxel from, int& best) const {
  const std::uint8_t parts = parts_[level][cube(corner, level)];
  const int half = 1 << level;
  const int nearest =
      (from.i >= corner.i + half ? 1 : 0) | (from.j >= corner.j + half ? 2 : 0) | (from.k >= corner.k + half ? 4 : 0);
  for (int flip : {0, 1, 2, 4, 3, 5, 6, 7}) {
    const int which = nearest ^ flip;
    if ((parts >> which & 1) == 0) continue;
    const Voxel below = corner + Voxel{which & 1, which >> 1 & 1, which >> 2} * half;
    const int least = distance_to_cube(from, below, half);
    if (least >= best) continue;
    if (level == 0)
      best = least;
    else
      visit(below, level - 1, from, best);
  }
}

}  // namespace sculpt
