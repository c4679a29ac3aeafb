// Along which directions ball and shank alone come to a voxel, once all is gone that is to be removed.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/cell/chain.hpp"
#include "core/material/voxel_grid.hpp"

namespace sculpt {

/// A bit for each direction of study_views.
using ViewSet = std::uint32_t;
/// By VoxelSet::index.
using ViewSets = std::vector<ViewSet>;

/// How a tool comes to a voxel: along one of the directions with its shank behind it; or, where a robot only shifts a
/// ball, any way that is open, which counts as the first direction.
enum class Access { along_views, any_way };
inline Access access_of(const Chain& chain) {
  return chain.translating() ? Access::any_way : Access::along_views;
}

/// Of all voxels that are not to be kept: the directions from which nothing of `keep` stands in the way of a tool that
/// fits through a voxel, however long it is. Throws Cancelled.
ViewSets find_views(const VoxelGrid& voxels, Access access, const RunContext& run);

}  // namespace sculpt
