// `mill`: carves with real tools. Each of them roughs, then finishes what it comes to; the rest is for the next one.
#pragma once

#include <functional>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/mill/left/cure.hpp"
#include "core/mill/mill_job.hpp"
#include "core/mill/tool_figures.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

struct MillResult {
  std::vector<ToolFigures> tools;
  VoxelSet left;                  ///< not removed at the end
  std::vector<Cure> cures;        ///< of what of it was to be removed
  std::vector<double> reachable;  ///< at points that these tools can come to: what stands above the surface (m)
};

/// Emits certified keyframes, in batches, and how many voxels each cut removes. Throws InputError, Cancelled.
MillResult mill(const MillJob& job, const std::function<void(std::vector<Keyframe>)>& emit, const RunContext& run);

}  // namespace sculpt
