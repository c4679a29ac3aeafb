#include "core/search/nearest_blocks.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace sculpt {
namespace {

constexpr int smallest_cell = 8;  // voxels an edge

int outside(int at, int low, int size) {
  return std::max({low - at, at - (low + size - 1), 0});
}

/// L1 from `from` to the nearest voxel of a cube.
int distance(Voxel from, Voxel corner, int size) {
  return outside(from.i, corner.i, size) + outside(from.j, corner.j, size) + outside(from.k, corner.k, size);
}

std::size_t cell_index(Voxel cell, std::size_t edge) {
  return static_cast<std::size_t>(cell.i) +
         edge * (static_cast<std::size_t>(cell.j) + edge * static_cast<std::size_t>(cell.k));
}

}  // namespace

/// `score` is distance less volume: what the heuristic of the paper ranks by, as the voxels left now are the same for
/// all.
struct NearestBlocks::Best {
  std::int64_t score = std::numeric_limits<std::int64_t>::max();
  std::uint32_t block = 0;
};

NearestBlocks::NearestBlocks(const Octree& octree) : octree_(octree) {
  for (int size = 1; size <= octree.n; size *= 2) {
    Tier tier{size, std::min(std::max(size, smallest_cell), octree.n), {}, {}};
    for (int edge = octree.n / tier.cell_size; edge > 0; edge /= 2)
      tier.counts.emplace_back(static_cast<std::size_t>(edge) * edge * edge);
    tier.cells.resize(tier.counts[0].size());
    tiers_.push_back(std::move(tier));
  }
}

NearestBlocks::Tier& NearestBlocks::tier_of(std::uint32_t block) {
  return tiers_[std::countr_zero(static_cast<unsigned>(octree_.leaves[block].size))];
}

void NearestBlocks::count(Tier& tier, Voxel corner, int change) {
  int size = tier.cell_size;
  for (auto& level : tier.counts) {
    level[cell_index({corner.i / size, corner.j / size, corner.k / size}, octree_.n / size)] +=
        static_cast<std::uint32_t>(change);
    size *= 2;
  }
}

void NearestBlocks::insert(std::uint32_t block) {
  Tier& tier = tier_of(block);
  const Voxel corner = octree_.leaves[block].corner;
  const int size = tier.cell_size;
  tier.cells[cell_index({corner.i / size, corner.j / size, corner.k / size}, octree_.n / size)].push_back(block);
  count(tier, corner, 1);
  ++size_;
}

void NearestBlocks::erase(std::uint32_t block) {
  Tier& tier = tier_of(block);
  const Voxel corner = octree_.leaves[block].corner;
  const int size = tier.cell_size;
  std::erase(tier.cells[cell_index({corner.i / size, corner.j / size, corner.k / size}, octree_.n / size)], block);
  count(tier, corner, -1);
  --size_;
}

void NearestBlocks::visit(const Tier& tier, Voxel cell, int level, Voxel from, Best& best) const {
  const int size = tier.cell_size << level;
  const std::size_t at = cell_index(cell, octree_.n / size);
  if (tier.counts[level][at] == 0) return;
  const std::int64_t volume = static_cast<std::int64_t>(tier.block_size) * tier.block_size * tier.block_size;
  // Equal scores in this tier still compete by id; against a larger tier they have lost already, but cannot win by
  // looking.
  if (distance(from, cell * size, size) - volume > best.score) return;
  if (level == 0) {
    for (std::uint32_t block : tier.cells[at]) {
      const std::int64_t score = distance(from, octree_.leaves[block].corner, tier.block_size) - volume;
      const bool tie = score == best.score && tier.block_size == octree_.leaves[best.block].size && block < best.block;
      if (score < best.score || tie) best = {score, block};
    }
    return;
  }
  const int half = size / 2;
  const int nearest = (from.i >= cell.i * size + half ? 1 : 0) | (from.j >= cell.j * size + half ? 2 : 0) |
                      (from.k >= cell.k * size + half ? 4 : 0);
  for (int flip : {0, 1, 2, 4, 3, 5, 6, 7}) {
    const int child = nearest ^ flip;
    visit(tier, cell * 2 + Voxel{child & 1, child >> 1 & 1, child >> 2}, level - 1, from, best);
  }
}

std::uint32_t NearestBlocks::best(Voxel from) const {
  Best found;
  for (auto tier = tiers_.rbegin(); tier != tiers_.rend(); ++tier)
    visit(*tier, {0, 0, 0}, static_cast<int>(tier->counts.size()) - 1, from, found);
  return found.block;
}

}  // namespace sculpt
