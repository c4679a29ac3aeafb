#include "core/motion/arm_carve.hpp"

#include "core/material/block_graph.hpp"
#include "core/motion/block_carve.hpp"

namespace sculpt {
namespace {

constexpr int max_effort = 2;

}  // namespace

ArmMemory carve_with_arm(Scene& scene, const ArmTask& task, const ArmStart& start, const ArmListener& listener,
                         const RunContext& run) {
  const BlockGraph graph = build_block_graph(task.octree, run.watch);
  Arm arm(scene, task.atlas, task.may_fall, task.home, run, listener.emit);
  const Voxel first = arm.at();
  arm.resume(start.keyframes, start.memory);
  const auto try_block = [&, tried = std::size_t{0}](int block, int effort) mutable {
    if (tried < start.trials.size()) return start.trials[tried++];
    const BlockTrial trial = carve_block(arm, task.octree.leaves[static_cast<std::size_t>(block)], effort);
    if (run.watch.stop.stop_requested()) throw Cancelled{};  // it may have been given up early
    listener.tried(trial, arm.memory());
    return trial;
  };
  order_blocks(task.octree, graph, first, max_effort, try_block, run.watch);
  arm.go_home();
  return arm.memory();
}

}  // namespace sculpt
