// Along which directions ball and shank alone come to a voxel, once all is gone that is to be removed.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/material/voxel_set.hpp"

namespace sculpt {

/// A bit for each direction of study_views.
using ViewSet = std::uint32_t;
/// By VoxelSet::index.
using ViewSets = std::vector<ViewSet>;

/// Of all voxels, whether they are to be kept or not: the directions from which nothing of `keep` stands in the way of
/// a tool that fits through a voxel, however long it is. Throws Cancelled.
ViewSets find_views(const VoxelSet& keep, const RunContext& run);

}  // namespace sculpt
