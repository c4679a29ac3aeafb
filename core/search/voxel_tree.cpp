#include "core/search/voxel_tree.hpp"

#include <algorithm>
#include <bit>

#include "core/search/nearest_first.hpp"

namespace sculpt {
namespace {

int log2_of(int power) {
  return std::countr_zero(static_cast<unsigned>(power));
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

std::optional<VoxelTree::Nearest> VoxelTree::nearest_about(Voxel from, int most) const {
  Nearest best{{}, most};
  visit_cubes_about(from, most - 1, log_size_ + 1, log_size_ + log_n_, [&](int log_size, Voxel corner, int distance) {
    const int level = log_size - log_size_ - 1;
    if (distance < best.distance && parts_[level][cube(corner, level)] != 0) visit(corner, level, from, best);
  });
  if (best.distance == most) return std::nullopt;
  return best;
}

void VoxelTree::visit(Voxel corner, int level, Voxel from, Nearest& best) const {
  const unsigned parts = parts_[level][cube(corner, level)];
  visit_eighths(corner, 1 << (log_size_ + level), from, [&](unsigned which, Voxel below, int distance) {
    if ((parts >> which & 1) == 0 || distance >= best.distance) return;
    if (level == 0)
      best = {below, distance};
    else
      visit(below, level - 1, from, best);
  });
}

}  // namespace sculpt
