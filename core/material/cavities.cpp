#include "core/material/cavities.hpp"

#include "core/material/flood.hpp"

namespace sculpt {

VoxelSet find_enclosed(const VoxelGrid& voxels) {
  VoxelSet passable = voxels.keep;
  for (std::uint64_t& word : passable.words()) word = ~word;
  VoxelSet enclosed = flood(passable, FloodFrom::sides_and_top);
  for (std::size_t at = 0; at < enclosed.words().size(); ++at)
    enclosed.words()[at] = voxels.stock.words()[at] & ~voxels.keep.words()[at] & ~enclosed.words()[at];
  return enclosed;
}

}  // namespace sculpt
