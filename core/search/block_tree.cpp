#include "core/search/block_tree.hpp"

#include <bit>

#include "core/search/nearest_first.hpp"

namespace sculpt {

BlockTree::BlockTree(int n) : log_n_(std::countr_zero(static_cast<unsigned>(n))) {
  for (int cubes = n / 2; cubes > 0; cubes /= 2) parts_.emplace_back(static_cast<std::size_t>(cubes) * cubes * cubes);
  parts_.emplace_back(1);
}

void BlockTree::insert(const Block& block) {
  const int own = std::countr_zero(static_cast<unsigned>(block.size));
  parts_[own][cube(block.corner, own)].are |= static_cast<std::uint8_t>(1 << part(block.corner, own));
  for (int level = own; level < static_cast<int>(parts_.size()); ++level) {
    Parts& parts = parts_[level][cube(block.corner, level)];
    const bool known = parts.hold != 0;
    parts.hold |= static_cast<std::uint8_t>(1 << part(block.corner, level));
    if (known) return;
  }
}

void BlockTree::erase(const Block& block) {
  const int own = std::countr_zero(static_cast<unsigned>(block.size));
  parts_[own][cube(block.corner, own)].are &= static_cast<std::uint8_t>(~(1 << part(block.corner, own)));
  for (int level = own; level < static_cast<int>(parts_.size()); ++level) {
    Parts& parts = parts_[level][cube(block.corner, level)];
    parts.hold &= static_cast<std::uint8_t>(~(1 << part(block.corner, level)));
    if (parts.hold != 0) return;
  }
}

std::optional<BlockTree::Nearest> BlockTree::nearest(Voxel from, int most) const {
  Nearest best{{}, 0, most};
  const int levels = static_cast<int>(parts_.size());
  visit_cubes_about(from, most - 1, 1, log_n_, [&](int log_size, Voxel corner, int distance) {
    if (distance >= best.distance) return;
    if (parts_[log_size - 1][cube(corner, log_size - 1)].hold != 0) return visit(corner, log_size - 1, from, best);
    for (int level = log_size; level < levels; ++level)  // a block that holds all of the cube
      if ((parts_[level][cube(corner, level)].are >> part(corner, level) & 1) != 0)
        best = {corner, 1 << level, distance};
  });
  if (best.distance == most) return std::nullopt;
  const auto aligned = [&](int at) { return at & ~(best.size - 1); };
  best.corner = {aligned(best.corner.i), aligned(best.corner.j), aligned(best.corner.k)};
  return best;
}

void BlockTree::visit(Voxel corner, int level, Voxel from, Nearest& best) const {
  const Parts parts = parts_[level][cube(corner, level)];
  const int half = 1 << level;
  visit_eighths(corner, half, from, [&](unsigned which, Voxel below, int distance) {
    if ((parts.hold >> which & 1) == 0 || distance >= best.distance) return;
    if ((parts.are >> which & 1) != 0)
      best = {below, half, distance};
    else
      visit(below, level - 1, from, best);
  });
}

}  // namespace sculpt
