// What the tool alone could come to, whatever arm holds it.
#pragma once

#include "core/base/watch.hpp"
#include "core/collision/scene.hpp"

namespace sculpt {

/// Of what stands in `scene` and is not `keep` all that can never be removed: ball and shank fit along none of the tool
/// axes even when everything is gone that they do fit at. Costs a few microseconds a standing voxel and axis, so it is
/// for what a plan has left over; the same on any number of threads. Throws Cancelled.
VoxelSet find_out_of_tool_reach(const Scene& scene, const VoxelSet& keep, int threads, const Watch& watch);

}  // namespace sculpt
