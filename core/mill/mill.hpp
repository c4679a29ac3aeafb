// `mill`: carves with real tools. Each of them roughs, then finishes what it comes to; the rest is for the next one.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/mill/left/cure.hpp"
#include "core/mill/mill_job.hpp"
#include "core/mill/mill_memory.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

struct MillResult {
  std::vector<ToolFigures> tools;
  VoxelSet left;                  ///< not removed at the end
  std::vector<Cure> cures;        ///< of what of it was to be removed
  std::vector<double> reachable;  ///< at points that these tools can come to: what stands above the surface (m)
};

/// Who hears of milling.
struct MillListener {
  std::function<void(std::vector<Keyframe>)> emit;
  std::function<void(MillMemory)> changed;  ///< a tool was changed: another run could go on here
};

/// Emits certified keyframes, in batches, and how many voxels each cut removes. Goes on at `start`, if there is one,
/// with the same keyframes that would have followed. Throws InputError, Cancelled.
MillResult mill(const MillJob& job, std::optional<MillStart> start, const MillListener& listener,
                const RunContext& run);

}  // namespace sculpt
