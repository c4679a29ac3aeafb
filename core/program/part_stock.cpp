#include "core/program/part_stock.hpp"

#include "core/material/binvox.hpp"

namespace sculpt {

std::string PartStock::at(std::size_t point) {
  for (; done_ <= point; ++done_)
    for (int voxel = 0; voxel < path_.edge_to(done_).voxels; ++voxel) standing_.erase(path_.voxel_of(done_, voxel));
  return write_binvox(standing_, path_.header().grid);
}

}  // namespace sculpt
