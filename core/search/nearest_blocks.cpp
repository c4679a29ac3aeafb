#include "core/search/nearest_blocks.hpp"

#include <bit>
#include <limits>

namespace sculpt {

NearestBlocks::NearestBlocks(int n) : all_(n) {
  for (int size = 1; size <= n; size *= 2) tiers_.emplace_back(n, size);
}

VoxelTree& NearestBlocks::tier_of(const Block& block) {
  return tiers_[std::countr_zero(static_cast<unsigned>(block.size))];
}

void NearestBlocks::insert(const Block& block) {
  tier_of(block).insert(block.corner);
  all_.insert(block);
  ++count_;
}

void NearestBlocks::erase(const Block& block) {
  tier_of(block).erase(block.corner);
  all_.erase(block);
  --count_;
}

Block NearestBlocks::best(Voxel from) const {
  // Distance less volume is what the heuristic of the paper ranks by: the voxels left now are the same for all.
  std::int64_t least = std::numeric_limits<std::int32_t>::max();
  Block best;
  for (std::size_t tier = tiers_.size(); tier-- > 0;) {
    const std::int64_t volume = std::int64_t{1} << 3 * tier;
    const std::int64_t most = std::min<std::int64_t>(least + volume, std::numeric_limits<int>::max());
    if (most <= 0 || tiers_[tier].empty()) continue;
    const auto found = tiers_[tier].nearest(from, static_cast<int>(most));
    if (!found) continue;
    least = found->distance - volume;
    best = {found->corner, 1 << tier, Label::remove};
  }
  return best;
}

std::optional<Block> NearestBlocks::nearest(Voxel from, int most) const {
  const auto found = all_.nearest(from, most);
  if (!found) return std::nullopt;
  return Block{found->corner, found->size, Label::remove};
}

}  // namespace sculpt
