#include "core/plan/carve.hpp"

#include <optional>

#include "core/motion/arm_carve.hpp"
#include "core/motion/gantry/gantry_carve.hpp"
#include "core/sweep/sweep.hpp"

namespace sculpt {
namespace {

/// What sweeps left that may still be cut, and of what else stands that which touches it: no more matters to its
/// blocks.
VoxelGrid left_to_cut(const SweepRest& left, const VoxelSet& keep) {
  const Grid bounds{keep.n(), 1, Vec3::Zero()};
  VoxelSet wanted = left.standing;
  wanted -= keep;
  for (const Voxel v : left.out_of_tool_reach) wanted.erase(v);
  VoxelGrid voxels{wanted, VoxelSet(keep.n())};
  for_each_voxel(wanted, [&](Voxel v) {
    for (const Voxel step : face_steps) {
      const Voxel beside = v + step;
      if (!bounds.contains(beside) || !left.standing.contains(beside) || wanted.contains(beside)) continue;
      voxels.stock.insert(beside);
      voxels.keep.insert(beside);
    }
  });
  return voxels;
}

SweepRest sweep(const Scene& scene, const CarveTask& task, const Carved& before, RunLog& log, const RunContext& run) {
  const Checkpoint& now = log.now();
  if (now.swept) return {before.standing, now.swept->out_of_tool_reach, {}};
  std::optional<SweepStart> start;
  if (now.sweeping) start = {*now.sweeping, before.standing, before.q};
  SweepRest left =
      carve_by_sweeps(scene, {task.voxels, task.may_fall, task.header.home, task.fields}, start, log.hear_sweep(), run);
  log.end_sweep(left);
  return left;
}

void carve_blocks(Scene& scene, const ArmTask& task, const Carved& before, RunLog& log, const RunContext& run) {
  const ArmStart start{log.now().trials, before.by_arm, log.now().arm};
  log.end_arm(carve_with_arm(scene, task, start, log.hear_arm(), run));
}

}  // namespace

void carve(Scene& scene, const CarveTask& task, const Carved& before, RunLog& log, const RunContext& run) {
  const Configuration& home = task.header.home;
  if (scene.chain().translating()) {
    const GantryTask all{task.voxels.keep, home, task.search, task.header.held ? &task.may_fall : nullptr};
    carve_with_gantry(scene, all, {log.now().file.keyframes, log.now().refusals}, log.hear_gantry(), run);
  } else if (task.search == Search::sweep) {
    const SweepRest left = sweep(scene, task, before, log, run);
    scene.leave(left.standing);
    const Octree rest = build_octree(left_to_cut(left, task.voxels.keep), run.watch);
    carve_blocks(scene, {rest, task.atlas, task.may_fall, home}, before, log, run);
  } else {
    carve_blocks(scene, {task.octree, task.atlas, task.may_fall, home}, before, log, run);
  }
  log.end_carving();
}

}  // namespace sculpt
