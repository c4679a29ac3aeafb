#include "core/plan/plan.hpp"

#include <gtest/gtest.h>

#include "core/material/cavities.hpp"
#include "tests/core/plan/jobs.hpp"
#include "tests/core/plan/soundness.hpp"

namespace sculpt {
namespace {

TEST(Plan, RandomShapesWithTheGantryLeaveOnlyWhatIsEnclosed) {
  const CellFiles cell = shipped_cell_files("gantry");
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ScratchFile file;
    const JobResult result = run_job(make_job(cell, random_target(seed % 2 == 0 ? 8 : 16, seed)), file.path(), {});
    expect_sound(result);
    for (const Residue& left : result.residue) EXPECT_EQ(left.reason, Reason::enclosed);
  }
}

TEST(Plan, RandomShapesVoxelByVoxelLeaveTheSameAsTheOctree) {
  const CellFiles cell = shipped_cell_files("gantry");
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Job job = make_job(cell, random_target(seed % 2 == 0 ? 8 : 16, seed));
    const ScratchFile by_octree, by_voxel;
    const JobResult octree = run_job(job, by_octree.path(), {});
    job.search = Search::voxel;
    const JobResult voxel = run_job(job, by_voxel.path(), {});
    expect_sound(voxel);
    EXPECT_EQ(voxel.report.voxels.removed, octree.report.voxels.removed);
  }
}

TEST(Plan, RandomShapesWithTheArmReplayClean) {
  const CellFiles cell = shipped_cell_files("panda-turntable");
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ScratchFile file;
    const JobResult result = run_job(make_job(cell, random_target(8, seed), seed), file.path(), {});
    expect_sound(result);
    EXPECT_GT(result.report.voxels.removed, result.report.voxels.remove / 2);
  }
}

TEST(Plan, SameJobAndSeedGiveTheSameBytesAndAnotherSeedAnotherPlan) {
  const CellFiles cell = shipped_cell_files("panda-turntable");
  const VoxelSet target = random_target(8, 3);
  const ScratchFile first, again, other;
  const std::string hash = run_job(make_job(cell, target, 5), first.path(), {}).report.plan_sha256;
  EXPECT_EQ(run_job(make_job(cell, target, 5), again.path(), {}).report.plan_sha256, hash);
  EXPECT_EQ(read_file(first.path()), read_file(again.path()));
  EXPECT_NE(run_job(make_job(cell, target, 6), other.path(), {}).report.plan_sha256, hash);
}

TEST(Plan, ThreadsDoNotChangeThePlan) {
  Job job = make_job(shipped_cell_files("panda-turntable"), random_target(8, 4));
  const ScratchFile first, second;
  const std::string one = run_job(job, first.path(), {}).report.plan_sha256;
  job.threads = 2;
  EXPECT_EQ(run_job(job, second.path(), {}).report.plan_sha256, one);
}

TEST(Plan, StockSmallerThanTheGridIsAirFromTheStart) {
  Job job = make_job(shipped_cell_files("panda-turntable"), VoxelSet(8));
  job.stock.box = Stock::Box{Vec3(0, 0, 0), Vec3(0.2, 0.2, 0.05)};
  const ScratchFile file;
  const JobResult result = run_job(job, file.path(), {});
  expect_sound(result);
  EXPECT_EQ(result.report.voxels.air, 8u * 8 * 6);
  EXPECT_EQ(result.report.voxels.removed, 8u * 8 * 2);
}

TEST(Plan, StopsSoonAfterItIsAskedTo) {
  const Job job = make_job(shipped_cell_files("panda-turntable"), random_target(32, 1));
  for (std::uint64_t after : {1u, 10u, 30u}) {
    std::stop_source stop;
    std::uint64_t steps = 0, after_stop = 0;
    const Watch watch{stop.get_token(), [&](const Progress& progress) {
                        if (stop.stop_requested()) ++after_stop;
                        if (progress.stage == Stage::plan && ++steps == after) stop.request_stop();
                      }};
    const ScratchFile file;
    EXPECT_THROW(run_job(job, file.path(), watch), Cancelled);
    EXPECT_EQ(after_stop, 0u) << "no step is taken after the stop";
  }
}

TEST(Plan, ProgressNeverPassesItsTotalAndEndsAtWhatWasRemoved) {
  const Job job = make_job(shipped_cell_files("gantry"), random_target(16, 2));
  std::uint64_t last = 0;
  const Watch watch{{}, [&](const Progress& progress) {
                      EXPECT_LE(progress.done, progress.total);
                      if (progress.stage == Stage::plan) last = progress.done;
                    }};
  const ScratchFile file;
  EXPECT_EQ(last = 0, 0u);
  const JobResult result = run_job(job, file.path(), watch);
  EXPECT_EQ(last, result.report.voxels.removed);
}

TEST(Plan, DavidAt64WithTheGantryIsCarvedWhole) {
  const auto mesh = shared_data() / "meshes/david.stl";
  if (!std::filesystem::exists(mesh))
    GTEST_SKIP() << "no david.stl: set SCULPT_SHARED_DATA to the folder of shared data";
  Job job;
  job.cell = shipped_cell_files("gantry");
  job.mesh = {read_file(mesh), "stl", "david.stl"};
  job.resolution = 64;
  const ScratchFile file;
  const JobResult result = run_job(job, file.path(), {});
  expect_sound(result);
  EXPECT_EQ(result.report.voxels.residue, find_enclosed(result.voxels).size());
}

}  // namespace
}  // namespace sculpt
