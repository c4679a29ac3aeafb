// A run with milling tools that is stopped or killed anywhere and resumed gives what it would have given.
#include <gtest/gtest.h>

#include "tests/core/mill/milled_plan.hpp"
#include "tests/core/mill/solids.hpp"
#include "tests/core/plan/checkpoint/job_folder.hpp"

namespace sculpt {
namespace {

namespace fs = std::filesystem;

Job two_tools(int threads) {
  const auto flat = [](double, double) { return 15.0; };
  Job job = milled::make_job_of(milled::height_field(30, 2, flat), 16, {"D20", "D12"});
  job.mill->tolerance_m = 1e-3;
  job.threads = threads;
  return job;
}

/// A run that nobody stops.
struct Undisturbed {
  explicit Undisturbed(int threads) {
    const Job job = two_tools(threads);
    expected = uninterrupted(job);
    const JobFolder folder(job);
    Watch watch;
    watch.tell = [&](const Progress& progress) {
      if (!fs::exists(folder.slot(0))) ++before_change;
      told.push_back(progress);
    };
    EXPECT_EQ(folder.run(watch, always), expected);
  }
  Outcome expected;
  std::vector<Progress> told;
  std::uint64_t before_change = 0;  ///< steps until there is the first checkpoint
};

const Undisturbed& undisturbed(int threads) {
  static const Undisturbed one(1), two(2);
  return threads == 1 ? one : two;
}

/// Stopped as soon as `is_there`. False if it ended all the same.
bool run_until(const JobFolder& folder, Interval interval, const std::function<bool(const Progress&)>& is_there) {
  std::stop_source stop;
  Watch watch;
  watch.stop = stop.get_token();
  watch.tell = [&](const Progress& progress) {
    if (is_there(progress)) stop.request_stop();
  };
  try {
    folder.run(watch, interval);
    return false;
  } catch (const Cancelled&) {
    return true;
  }
}

std::vector<Progress> told_by(const JobFolder& folder, const Outcome& expected) {
  std::vector<Progress> told;
  Watch watch;
  watch.tell = [&](const Progress& progress) { told.push_back(progress); };
  EXPECT_EQ(folder.run(watch), expected);
  return told;
}

class StoppedMilling : public testing::TestWithParam<int> {};

TEST_P(StoppedMilling, EndsWithTheSameBytesWhereverItWasStopped) {
  const Job job = two_tools(GetParam());
  const Undisturbed& run = undisturbed(GetParam());
  const auto end = static_cast<std::uint64_t>(before_replay(run.told));
  const std::uint64_t change = run.before_change;
  ASSERT_LT(change + 2, end);
  for (const std::uint64_t last : {change / 2, change, (change + end) / 2, end - 1}) {
    SCOPED_TRACE("stopped at step " + std::to_string(last) + ", tools were changed at " + std::to_string(change));
    const JobFolder folder(job);
    ASSERT_TRUE(folder.run_stopped(last));
    const auto checkpoint = folder.checkpoint();
    ASSERT_EQ(checkpoint.has_value(), last >= change);
    EXPECT_TRUE(!checkpoint || checkpoint->milling->tools.size() == 2);
    EXPECT_EQ(folder.run(), run.expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, StoppedMilling, testing::Values(1, 2));

TEST(ResumedMilling, GoesOnWithTheToolThatWasPutInLast) {
  const JobFolder folder(two_tools(2));
  ASSERT_TRUE(run_until(folder, always, [&](const Progress&) { return fs::exists(folder.slot(0)); }));
  const auto checkpoint = folder.checkpoint();
  ASSERT_TRUE(checkpoint && checkpoint->milling);
  const std::vector<ToolFigures>& tools = checkpoint->milling->tools;
  EXPECT_GT(tools.front().removed, 0U);
  EXPECT_EQ(tools.back().removed, 0U);
  const std::vector<Progress> told = told_by(folder, undisturbed(2).expected);
  EXPECT_EQ(std::ranges::find(told, Stage::plan, &Progress::stage)->done, tools.front().removed);
}

TEST(ResumedMilling, KnowsAtTheNextChangeWhatItWouldHaveKnown) {
  Job job = two_tools(2);
  job.mill->tools.push_back("D6");
  const JobFolder whole(job), stopped(job);
  const Outcome expected = whole.run();
  ASSERT_TRUE(run_until(stopped, always, [&](const Progress&) { return fs::exists(stopped.slot(0)); }));
  EXPECT_EQ(stopped.run(), expected);
  for (const int slot : {0, 1}) EXPECT_TRUE(read_file(stopped.slot(slot)) == read_file(whole.slot(slot))) << slot;
}

// No file says where a tool would come to: the next one may be shorter.
TEST(ResumedMilling, CountsAsReachableWhatToolsBeforeCameTo) {
  const Job job = two_tools(2);
  const JobFolder folder(job);
  ASSERT_TRUE(run_until(folder, always, [&](const Progress&) { return fs::exists(folder.slot(0)); }));
  CheckpointFolder kept(folder.folder(), folder.trajectory(), job_key(job), always);
  auto checkpoint = kept.find_newest();
  ASSERT_TRUE(checkpoint && checkpoint->milling);
  std::vector<char>& reachable = checkpoint->milling->reachable;
  const auto points = [](const Outcome& outcome) -> std::uint64_t {
    return nlohmann::json::parse(outcome.report)["surface"]["reachable"]["points"];
  };
  EXPECT_LT(points(undisturbed(2).expected), reachable.size());
  std::ranges::fill(reachable, char{1});
  kept.save(*checkpoint);
  EXPECT_EQ(points(folder.run()), reachable.size());
}

TEST(ResumedMilling, KilledAgainAndAgainEndsWithTheSameBytes) {
  const Undisturbed& run = undisturbed(1);
  const auto end = static_cast<std::uint64_t>(before_replay(run.told));
  const JobFolder folder(two_tools(1));
  EXPECT_TRUE(folder.run_killed((run.before_change + end) / 2));
  EXPECT_TRUE(folder.checkpoint());
  EXPECT_TRUE(folder.run_killed((end - run.before_change) / 2));
  EXPECT_EQ(folder.run(), run.expected);
  EXPECT_EQ(folder.run(), run.expected) << "from the last checkpoint of all";
}

TEST(ResumedMilling, OfAPlanThatIsWholeOnlyReplays) {
  const JobFolder folder(two_tools(2));
  ASSERT_TRUE(run_until(folder, at_stops_only, [](const Progress& at) { return at.stage == Stage::verify; }));
  const auto checkpoint = folder.checkpoint();
  ASSERT_TRUE(checkpoint && checkpoint->milled && checkpoint->residue);
  EXPECT_FALSE(checkpoint->milling);
  const std::vector<Progress> told = told_by(folder, undisturbed(2).expected);
  EXPECT_EQ(std::ranges::count(told, Stage::plan, &Progress::stage), 0);
}

TEST(ResumedMilling, StartsOverWhereItsCheckpointOrItsTrajectoryIsDamaged) {
  for (const bool is_checkpoint : {true, false}) {
    const JobFolder folder(two_tools(2));
    ASSERT_TRUE(run_until(folder, always, [&](const Progress&) { return fs::exists(folder.slot(0)); }));
    const fs::path file = is_checkpoint ? folder.slot(0) : folder.trajectory();
    fs::resize_file(file, fs::file_size(file) / 2);
    EXPECT_FALSE(folder.checkpoint());
    EXPECT_EQ(folder.run(), undisturbed(2).expected);
  }
}

}  // namespace
}  // namespace sculpt
