// Material only shrinks, so what can be removed in the end depends neither on the seed nor on the order of the blocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/base/random.hpp"
#include "core/material/octree.hpp"
#include "core/motion/block_carve.hpp"
#include "core/motion/explain_residue.hpp"
#include "core/motion/tool/tool_axes.hpp"
#include "core/plan/intake.hpp"
#include "core/trajectory/quantum.hpp"
#include "tests/core/base/cases.hpp"
#include "tests/core/plan/scenarios.hpp"
#include "tests/core/plan/soundness.hpp"

namespace sculpt {
namespace {

constexpr int max_effort = 2;

std::string text(const std::map<Voxel, Reason>& left) {
  std::string sentence = std::to_string(left.size()) + " voxels left:";
  for (const auto& [v, reason] : left)
    sentence +=
        " (" + std::to_string(v.i) + "," + std::to_string(v.j) + "," + std::to_string(v.k) + ") " + name(reason);
  return sentence;
}

std::map<Voxel, Reason> plan(Job job, std::uint64_t seed) {
  job.seed = seed;
  const ScratchFile file;
  const JobResult result = run_job(job, file.path(), {});
  expect_sound(result);
  return left_of(result);
}

/// Shuffled at every pass, with no regard to distance, size or neighbours: another order than that of the planner.
std::map<Voxel, Reason> carve_in_random_order(const Job& job, std::uint64_t order_seed) {
  const Cell cell = parse_cell(job.cell);
  const Grid grid = cell.grid(job.resolution);
  const VoxelGrid voxels = make_voxels(job, grid, {});
  const Octree octree = build_octree(voxels, {});
  Scene scene(cell, grid, voxels.stock);
  const PostureAtlas atlas(scene.chain(), grid, job.seed);
  const Helpers helpers(2);
  const Watch watch;
  const RunContext run{job.seed, helpers, watch};
  Arm arm(scene, atlas, find_unheld(voxels), rounded(cell.home(scene.chain())), run, [](const Keyframe&) {});
  std::vector<Block> left;
  for (const Block& block : octree.leaves)
    if (block.label == Label::remove) left.push_back(block);
  Random random(order_seed);
  for (int effort = 0; effort <= max_effort && !left.empty();) {
    for (std::size_t b = left.size(); b-- > 1;) std::swap(left[b], left[random.next() % (b + 1)]);
    int removed = 0;
    std::erase_if(left, [&](const Block& block) {
      const BlockTrial trial = carve_block(arm, block, effort);
      removed += trial.removed;
      return trial.left == 0;
    });
    if (removed == 0) ++effort;
  }
  std::map<Voxel, Reason> residue;
  for (const Residue& one : explain_residue(scene, atlas, voxels, find_unheld(voxels), run))
    residue[one.voxel] = one.reason;
  return residue;
}

/// Removes whatever the tool alone fits at from some side until nothing more goes: no joints, no links, no ways.
std::set<Voxel> beyond_the_tool(const Job& job) {
  const Cell cell = parse_cell(job.cell);
  const Grid grid = cell.grid(job.resolution);
  const VoxelGrid voxels = make_voxels(job, grid, {});
  Scene scene(cell, grid, voxels.stock);
  std::set<Voxel> left;
  for (int k = 0; k < grid.n; ++k)
    for (int j = 0; j < grid.n; ++j)
      for (int i = 0; i < grid.n; ++i)
        if (voxels.label({i, j, k}) == Label::remove) left.insert({i, j, k});
  const std::vector<Vec3> axes = tool_axes();
  const auto goes = [&](Voxel v) {
    const bool fits = std::any_of(axes.begin(), axes.end(), [&](const Vec3& axis) {
      return scene.tool_fits({grid.centre(v), axis}, v);
    });
    if (fits) scene.remove(v);
    return fits;
  };
  while (std::erase_if(left, goes) > 0) {
  }
  return left;
}

/// A cut needs a voxel that the tool fits at, and where it fits once it fits for ever. So what goes depends on the
/// order only if joints, links or the search for ways forbid what the tool alone could do. Here they forbid nothing.
std::map<Voxel, Reason> expect_the_same_whatever_the_order(const Job& job, std::uint64_t seeds) {
  const std::map<Voxel, Reason> left = plan(job, 0);
  std::set<Voxel> where;
  for (const auto& [voxel, reason] : left) where.insert(voxel);
  EXPECT_TRUE(where == beyond_the_tool(job)) << text(left);
  for (std::uint64_t seed = 1; seed < cases(seeds); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    EXPECT_EQ(text(plan(job, seed)), text(left));
  }
  SCOPED_TRACE("blocks in random order");
  EXPECT_EQ(text(carve_in_random_order(job, 1)), text(left));
  return left;
}

Job mesh_job(const std::filesystem::path& mesh, int resolution) {
  Job job;
  job.mesh = {read_file(mesh), "stl", mesh.filename().string()};
  job.cell = shipped_cell_files("panda-turntable");
  job.resolution = resolution;
  return job;
}

/// Single voxels of keep in a random part of all places, as far as they hang together from the floor up: channels that
/// the tool comes into from some sides. What holds a loose part would depend on the order.
VoxelSet random_sponge(int n, std::uint64_t seed) {
  Random random(seed);
  const double share = random.between(0.3, 0.42);
  VoxelSet target(n);
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        if (random.unit() < share) target.insert({i, j, k});
  return on_the_floor(std::move(target));
}

TEST(Order, TheBustAt16IsCarvedWhole) {
  EXPECT_TRUE(expect_the_same_whatever_the_order(mesh_job(SOURCE_DIR "/config/samples/bust.stl", 16), 5).empty());
}

TEST(Order, DavidAt16IsCarvedWhole) {
  const auto mesh = shared_data() / "meshes/david.stl";
  if (!std::filesystem::exists(mesh))
    GTEST_SKIP() << "no david.stl: set SCULPT_SHARED_DATA to the folder of shared data";
  EXPECT_TRUE(expect_the_same_whatever_the_order(mesh_job(mesh, 16), 5).empty());
}

TEST(Order, TheVaseAt16KeepsTheSameVoxels) {
  EXPECT_FALSE(expect_the_same_whatever_the_order(scenario("vase", "panda-turntable", 16), 5).empty());
}

TEST(Order, RandomSpongesKeepTheSameVoxels) {
  for (std::uint64_t seed : {0, 1, 4}) {
    SCOPED_TRACE("target " + std::to_string(seed));
    const Job job = make_job(shipped_cell_files("panda-turntable"), random_sponge(8, seed));
    EXPECT_FALSE(expect_the_same_whatever_the_order(job, 2).empty());
  }
}

}  // namespace
}  // namespace sculpt
