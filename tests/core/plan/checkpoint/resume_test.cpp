// A run that is killed anywhere and resumed gives what it would have given.
#include <gtest/gtest.h>

#include "tests/core/plan/checkpoint/job_folder.hpp"

namespace sculpt {
namespace {

namespace fs = std::filesystem;

struct Kind {
  const char* name;
  const char* cell;
  const char* search;
  int resolution;
  std::int64_t unit;  ///< voxels cut between two places that a run can go on from, at most
};

class Resume : public testing::TestWithParam<Kind> {
 protected:
  static Job job(std::uint64_t seed) {
    const CellFiles cell =
        std::string(GetParam().cell) == "clamped gantry" ? clamped_gantry() : shipped_cell_files(GetParam().cell);
    Job job = make_job(cell, random_target(GetParam().resolution, seed), seed);
    job.search = parse_search(GetParam().search);
    job.threads = 1 + static_cast<int>(seed % 2);
    return job;
  }
};

TEST_P(Resume, KilledAnywhereItEndsWithTheSameBytes) {
  int kills = 0;
  for (std::uint64_t seed = 0; seed < 13; ++seed) {
    const Job job = this->job(seed);
    std::vector<Progress> told;
    const Outcome expected = uninterrupted(job, &told);
    const std::uint64_t last = Random(seed).next() % told.size();
    SCOPED_TRACE("seed " + std::to_string(seed) + ", killed at step " + std::to_string(last));
    const JobFolder folder(job);
    if (folder.run_killed(last, seed % 4 == 3 ? now_and_then : always)) ++kills;
    EXPECT_EQ(folder.run(), expected);
    EXPECT_EQ(folder.run(), expected) << "from the last checkpoint of all";
  }
  EXPECT_GE(kills, 7) << "those of one thread";
}

TEST_P(Resume, KilledAgainAndAgainItEndsWithTheSameBytes) {
  for (std::uint64_t seed = 20; seed < 22; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Job job = this->job(seed);
    std::vector<Progress> told;
    const Outcome expected = uninterrupted(job, &told);
    const auto steps = static_cast<std::uint64_t>(before_replay(told));
    const JobFolder folder(job);
    Random random(seed);
    int kills = 0;
    while (kills < 12 && folder.run_killed(random.next() % steps)) ++kills;
    EXPECT_GT(kills, 0);
    EXPECT_EQ(folder.run(), expected);
  }
}

TEST_P(Resume, AStopKeepsWhateverUnitsHadFinished) {
  int stops = 0;
  for (std::uint64_t seed = 30; seed < 38; ++seed) {
    const Job job = this->job(seed);
    std::vector<Progress> told;
    const Outcome expected = uninterrupted(job, &told);
    const auto from = std::ranges::find(told, Stage::plan, &Progress::stage);
    const auto to = std::ranges::find(from, told.end(), Stage::verify, &Progress::stage);
    const auto last = from + static_cast<std::ptrdiff_t>(Random(seed).next() % static_cast<std::uint64_t>(to - from));
    SCOPED_TRACE("seed " + std::to_string(seed) + ", stopped at step " + std::to_string(last - told.begin()));
    const JobFolder folder(job);
    ASSERT_TRUE(folder.run_stopped(static_cast<std::uint64_t>(last - told.begin())));
    EXPECT_LE(static_cast<std::int64_t>(last->done) - static_cast<std::int64_t>(folder.kept()), GetParam().unit);
    stops += folder.kept() > 0;
    EXPECT_EQ(folder.run(), expected);
  }
  EXPECT_GT(stops, 0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Resume,
                         testing::Values(Kind{"OctreeArm", "panda-turntable", "octree", 8, 4 * 4 * 4},
                                         Kind{"SweepArm", "panda-turntable", "sweep", 8, 8 * 8 * 8},
                                         Kind{"LargerSweepArm", "panda-turntable", "sweep", 32, 16 * 32 * 32},
                                         Kind{"OctreeGantry", "gantry", "octree", 16, 16},
                                         Kind{"VoxelGantry", "gantry", "voxel", 16, 16},
                                         Kind{"ClampedGantry", "clamped gantry", "octree", 16, 16}),
                         [](const auto& kind) { return std::string(kind.param.name); });

Job arm_job() {
  Job job = make_job(shipped_cell_files("panda-turntable"), random_target(8, 3), 3);
  job.search = Search::octree;
  return job;
}

TEST(ResumedRun, DoesAgainNoMoreThanTheTrialItWasKilledIn) {
  const Job job = arm_job();
  std::vector<Progress> told;
  uninterrupted(job, &told);
  const auto first = std::ranges::find(told, Stage::plan, &Progress::stage);
  const auto end = std::ranges::find(first, told.end(), Stage::verify, &Progress::stage);
  constexpr std::uint64_t max_block = 4 * 4 * 4;
  for (int tenth = 2; tenth < 10; tenth += 2) {
    SCOPED_TRACE("killed after " + std::to_string(tenth) + " tenths of the planning");
    const JobFolder folder(job);
    const auto last = first + (end - first) * tenth / 10;
    ASSERT_TRUE(folder.run_killed(static_cast<std::uint64_t>(last - told.begin())));
    const auto checkpoint = folder.checkpoint();
    ASSERT_TRUE(checkpoint);
    std::uint64_t kept = 0;
    for (const BlockTrial& trial : checkpoint->trials) kept += static_cast<std::uint64_t>(trial.removed);
    EXPECT_GT(kept, 0u);
    EXPECT_LE(last->done - kept, max_block);
  }
}

/// The steps of planning proper: not the one that says what there is to do.
std::vector<std::uint64_t> planned(const std::vector<Progress>& told) {
  std::vector<std::uint64_t> done;
  for (const Progress& progress : told)
    if (progress.stage == Stage::plan && progress.done > 0) done.push_back(progress.done);
  return done;
}

TEST(ResumedRun, DoesAgainNoMoreOfASweepThanABatchOfLayers) {
  Job job = make_job(shipped_cell_files("panda-turntable"), random_target(64, 5), 5);
  constexpr std::uint64_t batch = 16 * 64 * 64;
  std::vector<Progress> told;
  {
    const JobFolder folder(job);
    std::stop_source stop;
    Watch watch{stop.get_token(), [&](const Progress& progress) {
                  told.push_back(progress);
                  if (progress.stage == Stage::verify) stop.request_stop();
                }};
    EXPECT_THROW(folder.run(watch, at_stops_only), Cancelled);
  }
  const std::vector<std::uint64_t> steps = planned(told);
  ASSERT_GT(steps.back(), 3 * batch) << "too few batches to see anything";
  const auto first = std::ranges::find_if(
      told, [](const Progress& progress) { return progress.stage == Stage::plan && progress.done > 0; });
  for (int tenth = 2; tenth < 10; ++tenth) {
    SCOPED_TRACE("killed after " + std::to_string(tenth) + " tenths of the planning");
    const JobFolder folder(job);
    const auto at = steps.size() * static_cast<std::size_t>(tenth) / 10;
    ASSERT_TRUE(folder.run_killed(static_cast<std::uint64_t>(first - told.begin()) + at));
    const std::uint64_t kept = folder.kept();
    EXPECT_GE(kept + batch, steps[at]);

    std::vector<Progress> again;
    std::stop_source stop;
    Watch watch{stop.get_token(), [&](const Progress& progress) {
                  again.push_back(progress);
                  if (progress.stage == Stage::verify) stop.request_stop();
                }};
    EXPECT_THROW(folder.run(watch, at_stops_only), Cancelled);
    const std::vector<std::uint64_t> left = planned(again);
    EXPECT_TRUE(
        std::ranges::equal(left, std::vector(steps.end() - static_cast<std::ptrdiff_t>(left.size()), steps.end())))
        << "the steps that were left, and no others";
    EXPECT_GE(left.front(), kept);
  }
}

TEST(ResumedRun, OfAFinishedPlanOnlyReplaysAndOnlyWhatWasNotReplayed) {
  Job job = make_job(shipped_cell_files("gantry"), random_target(32, 3), 3);
  job.search = Search::voxel;
  std::vector<Progress> told;
  const Outcome expected = uninterrupted(job, &told);
  const JobFolder folder(job);
  ASSERT_TRUE(folder.run_killed(told.size() - 2));
  const auto checkpoint = folder.checkpoint();
  ASSERT_TRUE(checkpoint && checkpoint->residue);
  EXPECT_GE(checkpoint->replayed.pieces, 2u);

  std::vector<Progress> again;
  Watch watch;
  watch.tell = [&](const Progress& progress) { again.push_back(progress); };
  EXPECT_EQ(folder.run(watch), expected);
  EXPECT_EQ(std::ranges::count(again, Stage::plan, &Progress::stage), 1) << "the one that says what there is to do";
  EXPECT_LT(std::ranges::count(again, Stage::verify, &Progress::stage),
            std::ranges::count(told, Stage::verify, &Progress::stage) / 2);
}

TEST(ResumedRun, GoesOnWithAReplayWhereItWasStopped) {
  Job job = make_job(shipped_cell_files("gantry"), random_target(32, 3), 3);
  job.search = Search::voxel;
  std::vector<Progress> told;
  const Outcome expected = uninterrupted(job, &told);
  const JobFolder folder(job);
  ASSERT_TRUE(folder.run_stopped(told.size() - 3));
  const auto checkpoint = folder.checkpoint();
  ASSERT_TRUE(checkpoint && checkpoint->residue);
  EXPECT_GE(checkpoint->replayed.pieces, 2u);
  EXPECT_EQ(folder.run(), expected);
}

/// Killed in the middle of planning, with two checkpoints.
class DamagedCheckpoint : public testing::Test {
 protected:
  void SetUp() override {
    std::vector<Progress> told;
    expected_ = uninterrupted(arm_job(), &told);
    ASSERT_TRUE(folder_.run_killed(static_cast<std::uint64_t>(before_replay(told)) * 2 / 3));
    trials_ = folder_.checkpoint()->trials.size();
    newest_ = read_checkpoint(read_file(folder_.slot(0)), job_key(arm_job()))->number >
                      read_checkpoint(read_file(folder_.slot(1)), job_key(arm_job()))->number
                  ? 0
                  : 1;
  }
  void damage(const fs::path& file, std::uint64_t at) {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(at));
    const char byte = static_cast<char>(stream.get() ^ 1);
    stream.seekp(static_cast<std::streamoff>(at));
    stream.put(byte);
  }

  const JobFolder folder_{arm_job()};
  Outcome expected_;
  std::size_t trials_ = 0;
  int newest_ = 0;
};

TEST_F(DamagedCheckpoint, CostsNoMoreThanTheOneBeforeIt) {
  damage(folder_.slot(newest_), 100);
  ASSERT_TRUE(folder_.checkpoint());
  EXPECT_EQ(folder_.checkpoint()->trials.size(), trials_ - 1);
  EXPECT_EQ(folder_.run(), expected_);
}

TEST_F(DamagedCheckpoint, OrCutShortCostsNoMoreThanTheOneBeforeIt) {
  fs::resize_file(folder_.slot(newest_), fs::file_size(folder_.slot(newest_)) / 2);
  EXPECT_EQ(folder_.checkpoint()->trials.size(), trials_ - 1);
  EXPECT_EQ(folder_.run(), expected_);
}

TEST_F(DamagedCheckpoint, AndTheOneBeforeItTooItStartsOver) {
  damage(folder_.slot(0), 100);
  damage(folder_.slot(1), 100);
  EXPECT_FALSE(folder_.checkpoint());
  EXPECT_EQ(folder_.run(), expected_);
}

TEST_F(DamagedCheckpoint, IsAlsoOneWhoseTrajectoryIsDamaged) {
  const std::uint64_t bytes = folder_.checkpoint()->file.bytes;
  damage(folder_.trajectory(), bytes - 20);
  const auto before = folder_.checkpoint();
  EXPECT_TRUE(!before || before->file.bytes < bytes - 20);
  damage(folder_.trajectory(), 5);
  EXPECT_FALSE(folder_.checkpoint());
  EXPECT_EQ(folder_.run(), expected_);
}

TEST_F(DamagedCheckpoint, IsAlsoOneWhoseTrajectoryIsShorterOrGone) {
  fs::resize_file(folder_.trajectory(), folder_.checkpoint()->file.bytes - 1);
  const auto before = folder_.checkpoint();
  EXPECT_TRUE(!before || before->trials.size() < trials_);
  fs::remove(folder_.trajectory());
  EXPECT_FALSE(folder_.checkpoint());
  EXPECT_EQ(folder_.run(), expected_);
}

TEST(CheckpointFolder, IsEmptyOnceTheyAreRemoved) {
  const JobFolder folder(arm_job());
  folder.run();
  ASSERT_TRUE(fs::exists(folder.slot(0)));
  remove_checkpoints(folder.folder());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.folder()), {}), 2) << "the trajectory and its timeline";
}

}  // namespace
}  // namespace sculpt
