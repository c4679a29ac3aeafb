// The `sweep` planner: tool directions are chosen, rows are cut layer by layer, every edge is certified
// (docs/planner.md).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/collision/scene.hpp"
#include "core/material/voxel_grid.hpp"
#include "core/sweep/field/field_store.hpp"
#include "core/sweep/sweep_memory.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// What sweeps are to carve; it must outlive them.
struct SweepTask {
  const VoxelGrid& voxels;
  const VoxelSet& may_fall;  ///< what cannot be held
  const Configuration& home;
  FieldStore fields = {};  ///< of the scene, home and seed
};

/// Voxels, by what sweeps did of them.
struct SweepFigures {
  std::uint64_t cut = 0, left = 0;  ///< left: of what some tool could come to
  std::uint64_t uncovered = 0;      ///< of these: no field that was found is usable there
};

/// What sweeps leave standing.
struct SweepRest {
  VoxelSet standing;
  std::vector<Voxel> out_of_tool_reach;  ///< to be removed, but never can be, as find_out_of_tool_reach has it
  SweepFigures figures;
};

/// Where a sweep goes on.
struct SweepStart {
  SweepMemory memory;
  VoxelSet standing;  ///< after all keyframes until then
  Configuration q;    ///< of the last one; home if there is none
};

/// Who hears of a sweep, on the calling thread.
struct SweepListener {
  std::function<void(std::vector<Keyframe>)> emit;  ///< keyframes, a batch at a time
  std::function<void()> ready = [] {};              ///< the fields are found that are known at the start
  std::function<void(const SweepMemory&)> note = [](const SweepMemory&) {};  ///< another could go on here
};

/// Carves what the tool reaches along its axes, the straight and the tilted ones, from home and back to home; or goes
/// on with that at `start`, with the same keyframes that would have followed. `scene` holds the full stock and is not
/// changed: what is free against all of it is free for ever. Every edge that is emitted is certified. Throws Cancelled,
/// and InputError `no_transit` if there is no way home.
SweepRest carve_by_sweeps(const Scene& scene, const SweepTask& task, const std::optional<SweepStart>& start,
                          const SweepListener& listener, const RunContext& run);

}  // namespace sculpt
