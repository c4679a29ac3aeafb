#include "server/queue/scheduler.hpp"

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <new>

#include "tests/server/fake_planner.hpp"
#include "tests/server/temp_folder.hpp"
#include "tests/server/test_store.hpp"

namespace sculpt::server {
namespace {

class SchedulerTest : public testing::Test {
 protected:
  SchedulerTest() { spdlog::set_level(spdlog::level::off); }

  std::string add(const std::string& spec, const Schedule& schedule = {}) {
    std::string id = store->submit({{}, schedule, spec, {}, 1}).job.id;
    scheduler.wake();
    return id;
  }
  /// Waits for the scheduler's word.
  JobState await(const std::string& job, JobState wanted) {
    std::unique_lock lock(mutex);
    while (true) {
      const JobState state = store->find(job)->state;
      if (state == wanted || is_final(state)) return state;
      changed.wait(lock);
    }
  }
  void on_change() {
    const std::lock_guard lock(mutex);
    changed.notify_all();
  }

  static StoreRules rules() {
    StoreRules rules;
    rules.first_backoff_ms = 1;
    return rules;
  }

  // The spec is the wish.
  Ending run(const JobRecord& job, const Watch& watch) {
    watch.step(Stage::plan, 3, 4);
    priority_of_run = getpriority(PRIO_PROCESS, 0);
    if (job.spec == "input") throw InputError("mesh_empty", "no triangle");
    if (job.spec == "memory") throw std::bad_alloc();
    if (job.spec == "exception") throw std::runtime_error("a fault");
    if (job.spec == "number") throw 7;
    if (job.spec == "crash") throw CrashError("signal 11");
    if (job.spec == "hold") gate.pass(watch.stop);
    return {JobState::succeeded, {}, {}, {}, Cause::job};
  }

  TempFolder folder;
  std::unique_ptr<JobStore> store = open_test_store(folder.path() / "db", rules());
  std::mutex mutex;
  std::condition_variable changed;
  Gate gate;
  std::atomic<int> priority_of_run = 0;
  Scheduler scheduler{*store, [this](const JobRecord& job, const Watch& watch) { return run(job, watch); },
                      [this](const std::string&) { on_change(); }};
};

TEST_F(SchedulerTest, JobsRunToTheirEnd) {
  scheduler.start(2);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(await(add("fine"), JobState::succeeded), JobState::succeeded);
}

TEST_F(SchedulerTest, JobsThatWaitedBeforeTheStartRunToo) {
  const std::string job = add("fine");
  scheduler.start(1);
  EXPECT_EQ(await(job, JobState::succeeded), JobState::succeeded);
}

TEST_F(SchedulerTest, RunsLeaveTheCoresToWhoeverAnswersClients) {
  const int mine = getpriority(PRIO_PROCESS, 0);
  scheduler.start(1);
  await(add("fine"), JobState::succeeded);
  EXPECT_EQ(priority_of_run, std::min(mine + 10, 19));
  EXPECT_EQ(getpriority(PRIO_PROCESS, 0), mine);
}

TEST_F(SchedulerTest, WhateverARunThrowsTheWorkerLivesOn) {
  scheduler.start(1);
  const std::vector<std::pair<std::string, std::string>> wishes{{"input", "mesh_empty"},
                                                                {"memory", "out_of_memory"},
                                                                {"exception", "internal_error"},
                                                                {"number", "internal_error"}};
  for (const auto& [wish, code] : wishes) {
    const std::string job = add(wish);
    EXPECT_EQ(await(job, JobState::failed), JobState::failed) << wish;
    EXPECT_EQ(store->find(job)->error_code, code);
    EXPECT_FALSE(store->find(job)->error_sentence.empty());
  }
  EXPECT_EQ(await(add("fine"), JobState::succeeded), JobState::succeeded);
}

TEST_F(SchedulerTest, ARunningJobIsCancelledAndItsWorkerTakesTheNext) {
  scheduler.start(1);
  const std::string job = add("hold");
  ASSERT_EQ(await(job, JobState::running), JobState::running);
  ASSERT_EQ(store->cancel(job), JobState::cancelling);
  scheduler.stop_run(job);
  EXPECT_EQ(await(job, JobState::cancelled), JobState::cancelled);
  EXPECT_EQ(await(add("fine"), JobState::succeeded), JobState::succeeded);
}

TEST_F(SchedulerTest, CancellingRightAfterTheClaimIsNeverLost) {
  scheduler.start(2);
  for (int i = 0; i < 50; ++i) {
    const std::string job = add("hold");
    if (i % 2 == 0) await(job, JobState::running);
    store->cancel(job);
    scheduler.stop_run(job);
    ASSERT_EQ(await(job, JobState::cancelled), JobState::cancelled);
  }
}

TEST_F(SchedulerTest, AFaultThatMayPassIsTriedThreeTimesAndInputThatCannotWorkOnce) {
  scheduler.start(1);
  const std::string memory = add("memory"), input = add("input");
  EXPECT_EQ(await(memory, JobState::failed), JobState::failed);
  EXPECT_EQ(store->find(memory)->attempt, 3);
  EXPECT_EQ(await(input, JobState::failed), JobState::failed);
  EXPECT_EQ(store->find(input)->attempt, 1);
}

TEST_F(SchedulerTest, AJobThatCrashesTwiceIsQuarantined) {
  scheduler.start(2);
  const std::string job = add("crash");
  EXPECT_EQ(await(job, JobState::quarantined), JobState::quarantined);
  EXPECT_EQ(store->find(job)->attempt, 2);
  EXPECT_EQ(await(add("fine"), JobState::succeeded), JobState::succeeded);
}

TEST_F(SchedulerTest, AJobThatRunsTooLongFails) {
  scheduler.start(1);
  const std::string job = add("hold", {0, {}, {}, 1});
  EXPECT_EQ(await(job, JobState::failed), JobState::failed);
  EXPECT_EQ(store->find(job)->error_code, "run_time_exceeded");
}

TEST_F(SchedulerTest, ARunningJobIsPausedAndGoesOnWhenItIsResumed) {
  scheduler.start(1);
  const std::string job = add("hold");
  ASSERT_EQ(await(job, JobState::running), JobState::running);
  ASSERT_EQ(store->pause(job), JobState::pausing);
  scheduler.stop_run(job);
  EXPECT_EQ(await(job, JobState::paused), JobState::paused);
  EXPECT_EQ(await(add("fine"), JobState::succeeded), JobState::succeeded);
  gate.open();
  ASSERT_EQ(store->resume(job), JobState::queued);
  scheduler.wake();
  EXPECT_EQ(await(job, JobState::succeeded), JobState::succeeded);
  EXPECT_EQ(store->find(job)->attempt, 2);
}

TEST_F(SchedulerTest, AHeldJobStartsWhenItsTimeHasCome) {
  scheduler.start(1);
  const std::string job = add("fine", {0, utc_text(unix_ms() + 300), {}, 0});
  EXPECT_EQ(store->find(job)->state, JobState::held);
  EXPECT_EQ(await(job, JobState::succeeded), JobState::succeeded);
}

TEST_F(SchedulerTest, StoppingPutsRunningJobsBackIntoTheQueue) {
  scheduler.start(2);
  const std::string first = add("hold"), second = add("hold"), third = add("hold");
  await(first, JobState::running);
  await(second, JobState::running);
  scheduler.stop();
  for (const std::string& job : {first, second, third}) EXPECT_EQ(store->find(job)->state, JobState::queued);
  EXPECT_EQ(store->find(first)->attempt, 1);
  EXPECT_EQ(store->find(third)->attempt, 0);
}

TEST_F(SchedulerTest, ProgressIsSeenWhileTheJobRuns) {
  scheduler.start(1);
  const std::string job = add("hold");
  await(job, JobState::running);
  std::optional<Progress> progress;
  while (!progress) progress = scheduler.progress(job);
  EXPECT_EQ(progress->done, 3u);
  EXPECT_EQ(progress->total, 4u);
  gate.open();
  await(job, JobState::succeeded);
  scheduler.stop();
  EXPECT_FALSE(scheduler.progress(job));
}

}  // namespace
}  // namespace sculpt::server
