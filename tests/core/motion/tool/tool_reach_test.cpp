#include "core/motion/tool/tool_reach.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/collision/material.hpp"
#include "core/motion/tool/tool_axes.hpp"
#include "core/plan/plan.hpp"
#include "tests/core/plan/jobs.hpp"

namespace sculpt {
namespace {

/// A hollow box with a hole of one voxel in its top or a side.
VoxelSet jar(std::uint64_t seed) {
  VoxelSet target(8);
  for (int k = 0; k < 7; ++k)
    for (int j = 1; j < 7; ++j)
      for (int i = 1; i < 7; ++i)
        if (i == 1 || i == 6 || j == 1 || j == 6 || k == 0 || k == 6) target.insert({i, j, k});
  Random random(seed);
  const int a = static_cast<int>(random.between(2, 6)), b = static_cast<int>(random.between(2, 6));
  const Voxel holes[]{{a, b, 6}, {1, a, b}, {6, a, b}, {a, 1, b}, {a, 6, b}};
  target.erase(holes[seed % 5]);
  return target;
}

/// As the definition has it: again and again, until nothing can be taken away any more, by capsules.
std::vector<Voxel> find_by_capsules(const VoxelSet& standing, std::vector<Voxel> wanted,
                                    const std::vector<Voxel>& steps, double length) {
  Material material(standing);
  for (std::size_t before = wanted.size() + 1; wanted.size() < before;) {
    before = wanted.size();
    std::erase_if(wanted, [&](Voxel v) {
      const Vec3 ball(v.i + 0.5, v.j + 0.5, v.k + 0.5);
      const bool fits = std::any_of(steps.begin(), steps.end(), [&](Voxel step) {
        const Vec3 axis = Vec3(step.i, step.j, step.k).normalized();
        return !material.meets_capsule({ball, ball + length * axis}, 0.45, v);
      });
      if (fits) material.remove(v);
      return fits;
    });
  }
  return wanted;
}

TEST(ToolReach, IsWhatCapsulesSay) {
  std::size_t found = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const int n = seed % 2 == 0 ? 4 : 8;
    VoxelSet standing(n);
    std::vector<Voxel> wanted;
    const double keep = random.between(0, 0.4), air = random.between(0, 0.4);
    for_each_voxel(VoxelSet(n, true), [&](Voxel v) {
      if (random.unit() < air) return;
      standing.insert(v);
      if (random.unit() > keep) wanted.push_back(v);
    });
    std::vector<Voxel> steps = tool_steps();
    if (seed % 3 == 0) steps = {steps[static_cast<std::size_t>(random.between(0, 17))]};
    const std::vector<Voxel> never = find_out_of_tool_reach(standing, wanted, steps, 2 * n, {});
    EXPECT_EQ(never, find_by_capsules(standing, wanted, steps, 2 * n));
    found += never.size();

    // The end of a short tool is taken to be thinner than it is: no voxel is set aside that it does come to.
    const std::vector<Voxel> left = find_by_capsules(standing, wanted, steps, 3);
    for (const Voxel v : find_out_of_tool_reach(standing, wanted, steps, 3, {}))
      EXPECT_NE(std::find(left.begin(), left.end(), v), left.end());
  }
  EXPECT_GT(found, 200u);
}

TEST(ToolReach, IsJustWhatTheArmsSearchLeaves) {
  const CellFiles files = shipped_cell_files("panda-turntable");
  const Cell cell = parse_cell(files);
  int out_of_reach = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    // A part that hangs on nothing would keep some of what is about it standing.
    const VoxelSet target = on_the_floor(seed % 2 == 0 ? jar(seed) : random_target(8, seed));
    std::vector<Voxel> wanted;
    for_each_voxel(VoxelSet(8, true), [&](Voxel v) {
      if (!target.contains(v)) wanted.push_back(v);
    });
    const double length = cell.tool.stickout_m / cell.grid(8).voxel_m;
    const std::vector<Voxel> never = find_out_of_tool_reach(VoxelSet(8, true), wanted, tool_steps(), length, {});
    out_of_reach += static_cast<int>(never.size());
    Job job = make_job(files, target, seed);
    job.search = Search::octree;
    const ScratchFile file;
    const JobResult result = run_job(job, file.path(), {});
    std::vector<Voxel> left;
    for (const Residue& residue : result.residue) left.push_back(residue.voxel);
    EXPECT_EQ(left, never);
  }
  EXPECT_GT(out_of_reach, 100) << "the shapes no longer hide anything";
}

TEST(ToolReach, StopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(find_out_of_tool_reach(VoxelSet(8, true), {{0, 0, 0}}, tool_steps(), 20, {stop.get_token(), {}}),
               Cancelled);
}

}  // namespace
}  // namespace sculpt
