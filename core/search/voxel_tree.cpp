#include "core/search/voxel_tree.hpp"

#include <algorithm>
#include <bit>

namespace sculpt {
namespace {

int log2_of(int power) {
  return std::countr_zero(static_cast<unsigned>(power));
}

int outside(int at, int low, int size) {
  return std::max(std::max(low - at, at - (low + size - 1)), 0);
}

}  // namespace

VoxelTree::VoxelTree(int n, int size) : log_size_(log2_of(size)), log_n_(std::max(log2_of(n / size), 1)) {
  for (int edge = 1 << (log_n_ - 1); edge > 0; edge /= 2)
    parts_.emplace_back(static_cast<std::size_t>(edge) * edge * edge);
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

std::optional<VoxelTree::Nearest> VoxelTree::nearest(Voxel from, int most) const {
  Nearest best{{}, most};
  visit({0, 0, 0}, log_n_ - 1, from, best);
  if (best.distance == most) return std::nullopt;
  return best;
}

void VoxelTree::visit(Voxel corner, int level, Voxel from, Nearest& best) const {
  const unsigned parts = parts_[level][cube(corner, level)];
  const int half = 1 << (log_size_ + level);
  // How far outside of the lower and of the upper half, by axis.
  const int x[]{outside(from.i, corner.i, half), outside(from.i, corner.i + half, half)};
  const int y[]{outside(from.j, corner.j, half), outside(from.j, corner.j + half, half)};
  const int z[]{outside(from.k, corner.k, half), outside(from.k, corner.k + half, half)};
  const unsigned nearest = (x[1] < x[0] ? 1u : 0u) | (y[1] < y[0] ? 2u : 0u) | (z[1] < z[0] ? 4u : 0u);
  for (unsigned flip : {0u, 1u, 2u, 4u, 3u, 5u, 6u, 7u}) {
    const unsigned which = nearest ^ flip, i = which & 1, j = which >> 1 & 1, k = which >> 2;
    const int distance = x[i] + y[j] + z[k];
    if ((parts >> which & 1) == 0 || distance >= best.distance) continue;
    const Voxel below = corner + Voxel{static_cast<int>(i), static_cast<int>(j), static_cast<int>(k)} * half;
    if (level == 0)
      best = {below, distance};
    else
      visit(below, level - 1, from, best);
  }
}

}  // namespace sculpt
