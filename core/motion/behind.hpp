// Which of the voxels that the tool cannot come to only wait for others that were left.
#pragma once

#include <vector>

#include "core/base/helpers.hpp"
#include "core/base/watch.hpp"
#include "core/collision/scene.hpp"
#include "core/motion/residue.hpp"
#include "core/motion/tool/tool_room.hpp"

namespace sculpt {

/// Gives each voxel of `residue` with the reason `tool_cannot_reach` that the tool could come to, were only what was
/// left for other reasons gone, the reason that it is behind: of the ways to it the one whose worst voxel got farthest.
/// A robot that only shifts its tool comes to voxels through voxels: there it is those without air beside them.
/// `residue`: all of what `scene` still holds and should not, in index order. Throws Cancelled.
void find_behind(std::vector<Residue>& residue, const Scene& scene, const ToolRoom& room, const Helpers& helpers,
                 const Watch& watch);

}  // namespace sculpt
