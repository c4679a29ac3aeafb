#include "core/motion/arm_carve.hpp"

#include <algorithm>
#include <utility>

#include "core/material/block_graph.hpp"
#include "core/motion/block_carve.hpp"

namespace sculpt {
namespace {

constexpr int max_effort = 2;
/// Iterations of OMPL's searches that may find nothing, at first: few where there is little to gain.
constexpr std::uint64_t cell_iterations_a_voxel = 20, min_cell_iterations = 300, max_cell_iterations = 3000;

std::uint64_t iterations_for(const Octree& octree) {
  std::uint64_t voxels = 0;
  for (const Block& block : octree.leaves)
    if (block.label == Label::remove) voxels += static_cast<std::uint64_t>(block.size) * block.size * block.size;
  return std::clamp(cell_iterations_a_voxel * voxels, min_cell_iterations, max_cell_iterations);
}

}  // namespace

ArmMemory carve_with_arm(Scene& scene, const ArmTask& task, const ArmStart& start, const ArmListener& listener,
                         const RunContext& run) {
  const BlockGraph graph = build_block_graph(task.octree, run.watch);
  Arm arm(scene, task.atlas, task.may_fall, task.home, run, listener.emit);
  const Voxel first = arm.at();
  ArmMemory memory = start.memory;
  if (start.trials.empty()) memory.iterations_left = iterations_for(task.octree);
  arm.resume(start.keyframes, std::move(memory));
  std::size_t known = 0;
  const auto block_of = [&](int block) -> const Block& { return task.octree.leaves[static_cast<std::size_t>(block)]; };
  const auto try_block = [&](int block, int effort) {
    if (known < start.trials.size()) return start.trials[known++];
    const BlockTrial trial = carve_block(arm, block_of(block), effort);
    if (run.watch.stop.stop_requested()) throw Cancelled{};  // it may have been given up early
    listener.tried(trial, arm.memory());
    return trial;
  };
  const auto foresee = [&](std::span<const int> blocks, int effort) {
    if (known < start.trials.size() || run.helpers.threads() == 1) return;
    std::vector<std::vector<Arm::Descent>> of_each(blocks.size());
    run.helpers.for_each_index(blocks.size(),
                               [&](std::size_t i) { of_each[i] = find_descents(arm, block_of(blocks[i]), effort); });
    std::vector<Arm::Descent> all;
    for (const auto& descents : of_each) all.insert(all.end(), descents.begin(), descents.end());
    arm.look_ahead(all, effort);
  };
  order_blocks(task.octree, graph, first, max_effort, try_block, run.watch, foresee);
  arm.go_home();
  return arm.memory();
}

}  // namespace sculpt
