#include "core/motion/tool_reach.hpp"

#include <gtest/gtest.h>

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

TEST(ToolReach, IsJustWhatTheArmsSearchLeaves) {
  const CellFiles files = shipped_cell("panda-turntable");
  const Cell cell = parse_cell(files);
  int out_of_reach = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    // A part that hangs on nothing would keep some of what is about it standing.
    const VoxelSet target = on_the_floor(seed % 2 == 0 ? jar(seed) : random_target(8, seed));
    const Scene scene(cell, cell.grid(8), VoxelSet(8, true));
    const VoxelSet never = find_out_of_tool_reach(scene, target, 1, {});
    EXPECT_TRUE(find_out_of_tool_reach(scene, target, 3, {}) == never);
    out_of_reach += static_cast<int>(never.size());
    Job job = make_job(files, target, seed);
    job.search = "octree";
    const ScratchFile file;
    const JobResult result = run_job(job, file.path(), {});
    EXPECT_EQ(result.residue.size(), never.size());
    for (const Residue& left : result.residue) EXPECT_TRUE(never.contains(left.voxel));
  }
  EXPECT_GT(out_of_reach, 100) << "the shapes no longer hide anything";
}

TEST(ToolReach, StopsWhenAsked) {
  const Cell cell = parse_cell(shipped_cell("panda-turntable"));
  const Scene scene(cell, cell.grid(8), VoxelSet(8, true));
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(find_out_of_tool_reach(scene, VoxelSet(8), 2, {stop.get_token(), {}}), Cancelled);
}

}  // namespace
}  // namespace sculpt
