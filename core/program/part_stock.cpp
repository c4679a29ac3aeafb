#include "core/program/part_stock.hpp"

#include "core/material/binvox.hpp"

namespace sculpt {

PartStock::PartStock(const PlanPath& path) : path_(path), standing_(path.header().grid.n, true) {
  if (path.header().mill) milled_.emplace(path.header(), standing_);
}

std::string PartStock::at(std::size_t point) {
  for (; done_ <= point; ++done_)
    for (int voxel = 0; voxel < path_.edge_to(done_).voxels; ++voxel) standing_.erase(path_.voxel_of(done_, voxel));
  const std::vector<PlanPath::Milled>& milled = path_.milled();
  for (; keyframe_ < milled.size() && milled[keyframe_].point <= point; ++keyframe_)
    milled_->take(milled[keyframe_].step, milled[keyframe_].cut);
  return write_binvox(milled_ ? milled_->standing() : standing_, path_.header().grid);
}

}  // namespace sculpt
