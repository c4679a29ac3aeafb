#include "server/store/job_store.hpp"

#include <gtest/gtest.h>

#include "proto/error_codes.hpp"
#include "server/store/sqlite/sqlite.hpp"
#include "tests/server/store/job_store_fixture.hpp"

namespace sculpt::server {
namespace {

const Ending success{
    JobState::succeeded, {}, {}, {{"trajectory", "ndjson", 12, "abc"}, {"report", "json", 3, "def"}}, Cause::job};
const Ending failure{JobState::failed, "no_transit", "there is no way", {}, Cause::job};

std::string error_of(const std::function<void()>& act) {
  try {
    act();
    return "none";
  } catch (const proto::ProtocolError& error) {
    return error.code();
  }
}

TEST_F(JobStoreTest, JobsAreClaimedByPriorityThenInOrder) {
  const std::string low = add({}, -5), first = add({}, 3), second = add({}, 3), high = add({}, 7);
  for (const std::string& wanted : {high, first, second, low}) EXPECT_EQ(store->claim()->id, wanted);
  EXPECT_FALSE(store->claim());
}

TEST_F(JobStoreTest, TheListIsInTheOrderOfSubmissionAndCanBePaged) {
  std::vector<std::string> ids;
  for (int i = 0; i < 25; ++i) ids.push_back(add({}, i % 3));
  std::vector<std::string> listed;
  JobWindow window{.limit = 10};
  for (bool more = true; more;) {
    const JobPage page = store->list(window);
    for (const JobRecord& job : page.jobs) listed.push_back(job.id);
    window.after = listed.back();
    more = page.more;
  }
  EXPECT_EQ(listed, ids);
}

TEST_F(JobStoreTest, TheListCanBePagedFromTheNewestAndBetweenTwoJobs) {
  std::vector<std::string> ids;
  for (int i = 0; i < 25; ++i) ids.push_back(add());
  std::vector<std::string> listed;
  JobWindow window{.newest = true, .limit = 10};
  for (bool more = true; more;) {
    const JobPage page = store->list(window);
    for (const JobRecord& job : page.jobs) listed.insert(listed.begin(), job.id);
    window.before = listed.front();
    more = page.more;
  }
  EXPECT_EQ(listed, ids);
  const JobPage between = store->list({.after = ids[3], .before = ids[6], .newest = true});
  ASSERT_EQ(between.jobs.size(), 2u);
  EXPECT_EQ(between.jobs[0].id, ids[5]);
  EXPECT_EQ(between.jobs[1].id, ids[4]);
  EXPECT_FALSE(between.more);
}

TEST_F(JobStoreTest, ADamagedRowIsSetAsideAndThePageGoesOn) {
  SCULPT_SQLITE_ONLY();
  const std::string first = add(), damaged = add(), last = add();
  store.reset();
  Database(file()).run(("UPDATE job SET state='exploded' WHERE id='" + damaged + "'").c_str());
  store = open_sqlite_store(file());
  for (const bool newest : {false, true}) {
    const JobPage page = store->list({.newest = newest, .limit = 2});
    ASSERT_EQ(page.jobs.size(), 2u);
    EXPECT_EQ(page.jobs[newest ? 1 : 0].id, first);
    EXPECT_EQ(page.jobs[newest ? 0 : 1].id, last);
    ASSERT_EQ(page.damaged.size(), 1u);
    EXPECT_EQ(page.damaged[0].id, damaged);
    EXPECT_NE(page.damaged[0].why.find("exploded"), std::string::npos);
    EXPECT_FALSE(page.more);
  }
  EXPECT_EQ(store->claim()->id, first);
  EXPECT_EQ(store->claim()->id, last);
  EXPECT_FALSE(store->claim());
}

TEST_F(JobStoreTest, ARepeatedKeyGivesTheFirstJobAndAnotherSpecAConflict) {
  const Submitted first = store->submit({"order-1", {}, "{\"a\":1}", "bundle", 1});
  EXPECT_FALSE(first.duplicate);
  reopen();
  const Submitted again = store->submit({"order-1", {5, {}, {}, 0}, "{\"a\":1}", "other bundle", 1});
  EXPECT_TRUE(again.duplicate);
  EXPECT_EQ(again.job.id, first.job.id);
  EXPECT_EQ(error_of([&] { store->submit({"order-1", {}, "{\"a\":2}", "bundle", 1}); }), "key_conflict");
  EXPECT_EQ(store->list({}).jobs.size(), 1u);
}

TEST_F(JobStoreTest, JobsWithoutAKeyAreNeverDuplicates) {
  EXPECT_NE(add(), add());
}

TEST_F(JobStoreTest, WhatWasAcknowledgedIsThereAfterReopening) {
  const std::string queued = add("k", 2, "{\"q\":1}"), done = add({}, 9), failed = add({}, 8);
  store->claim();
  store->claim();
  ASSERT_TRUE(store->finish(done, 1, success));
  ASSERT_TRUE(store->finish(failed, 1, failure));
  const std::string epoch = store->epoch();
  reopen();
  EXPECT_EQ(store->epoch(), epoch);
  EXPECT_EQ(store->find(queued)->spec, "{\"q\":1}");
  EXPECT_EQ(store->find_key("k")->id, queued);
  EXPECT_EQ(state(done), JobState::succeeded);
  EXPECT_EQ(store->artifacts(done).size(), 2u);
  EXPECT_EQ(store->artifacts(done)[0].sha256, "abc");
  EXPECT_EQ(state(failed), JobState::failed);
  EXPECT_EQ(store->find(failed)->error_sentence, "there is no way");
  EXPECT_GT(add(), failed) << "ids must go on rising";
}

TEST_F(JobStoreTest, AJobThatRanAtACrashRunsAgainAndItsOldWorkerIsRefused) {
  const std::string job = add();
  ASSERT_EQ(store->claim()->attempt, 1);
  reopen();
  EXPECT_EQ(store->recover(), 1);
  EXPECT_EQ(state(job), JobState::queued);
  EXPECT_EQ(store->claim()->attempt, 2);
  EXPECT_FALSE(store->finish(job, 1, success)) << "a result of the first attempt counts no more";
  EXPECT_FALSE(store->release(job, 1));
  EXPECT_TRUE(store->finish(job, 2, success));
  EXPECT_FALSE(store->finish(job, 2, failure)) << "and the end is the end";
  EXPECT_EQ(state(job), JobState::succeeded);
}

TEST_F(JobStoreTest, AJobThatWasBeingCancelledAtACrashIsCancelled) {
  const std::string job = add();
  store->claim();
  EXPECT_EQ(store->cancel(job), JobState::cancelling);
  reopen();
  EXPECT_EQ(store->recover(), 1);
  EXPECT_EQ(state(job), JobState::cancelled);
}

TEST_F(JobStoreTest, CancelDoesWhatTheStateAllows) {
  const std::string queued = add({}, -1), running = add(), done = add({}, 1);
  store->claim();
  store->finish(done, 1, success);
  store->claim();
  EXPECT_EQ(store->cancel(queued), JobState::cancelled);
  EXPECT_EQ(store->cancel(queued), JobState::cancelled);
  EXPECT_EQ(store->cancel(running), JobState::cancelling);
  EXPECT_EQ(store->cancel(running), JobState::cancelling);
  EXPECT_EQ(error_of([&] { store->cancel(done); }), "wrong_state");
  EXPECT_EQ(error_of([&] { store->cancel("nobody"); }), "not_found");
  EXPECT_TRUE(store->finish(running, 1, success));
  EXPECT_EQ(state(running), JobState::cancelled) << "a result that comes too late is dropped";
  EXPECT_TRUE(store->artifacts(running).empty());
  EXPECT_FALSE(store->claim());
}

TEST_F(JobStoreTest, PositionCountsThoseThatComeFirst) {
  const std::string a = add(), b = add(), urgent = add({}, 10);
  EXPECT_EQ(store->position(*store->find(urgent)), 0u);
  EXPECT_EQ(store->position(*store->find(a)), 1u);
  EXPECT_EQ(store->position(*store->find(b)), 2u);
}

TEST_F(JobStoreTest, CountsAddUp) {
  add();
  add();
  store->claim();
  const auto counts = store->counts();
  EXPECT_EQ(counts.at(JobState::queued), 1u);
  EXPECT_EQ(counts.at(JobState::running), 1u);
  EXPECT_EQ(counts.at(JobState::failed), 0u);
}

TEST_F(JobStoreTest, ALowPriorityIsNeverStarved) {
  std::uint64_t now = 1'700'000'000'000;
  StoreRules rules;
  rules.now_ms = [&] { return now; };
  store = open_test_store(folder.path() / "aged", rules);
  const std::string patient = add({}, 0);
  for (int minute = 1; minute < 10; ++minute) {
    now += rules.ageing_ms;
    const std::string urgent = add({}, 10);
    EXPECT_EQ(store->claim()->id, urgent);
  }
  now += rules.ageing_ms;
  add({}, 10);
  EXPECT_EQ(store->claim()->id, patient) << "ten steps of priority are worth ten minutes and no more";
}

TEST_F(JobStoreTest, AClockThatWasSetBackLetsNobodyOvertake) {
  std::uint64_t now = 1'700'000'000'000;
  StoreRules rules;
  rules.now_ms = [&] { return now; };
  for (const bool reopened : {false, true}) {
    store = open_test_store(folder.path() / "clock", rules);
    const std::string first = add();
    now -= 3'600'000;
    if (reopened) store = open_test_store(folder.path() / "clock", rules);
    const std::string second = add();
    EXPECT_EQ(store->claim()->id, first);
    EXPECT_EQ(store->claim()->id, second);
  }
}

TEST_F(JobStoreTest, AJobThatTookItsProcessDownTwiceIsQuarantinedUntilItIsRetried) {
  const Ending crash{JobState::failed, "planner_crashed", "signal 11", {}, Cause::crash};
  const std::string job = add();
  EXPECT_FALSE(store->claim()->isolated);
  reopen();  // the daemon died while it ran
  store->recover();
  const JobRecord second = *store->claim();
  EXPECT_TRUE(second.isolated);
  ASSERT_TRUE(store->finish(job, second.attempt, crash));
  EXPECT_EQ(state(job), JobState::quarantined);
  EXPECT_EQ(store->find(job)->error_code, "planner_crashed");
  EXPECT_FALSE(store->claim());
  EXPECT_EQ(store->retry(job), JobState::queued);
  EXPECT_TRUE(store->claim()->isolated);
}

TEST_F(JobStoreTest, ADaemonThatIsKilledAgainAndAgainQuarantinesNobody) {
  const std::string job = add();
  for (int kill = 0; kill < 20; ++kill) {
    ASSERT_TRUE(store->claim()) << kill;
    reopen();
    store->recover();
  }
  EXPECT_EQ(state(job), JobState::queued);
}

TEST_F(JobStoreTest, SuspectsRunOneAtATimeAndOthersPassThem) {
  const std::string first = add(), second = add();
  store->claim();
  store->claim();
  reopen();
  store->recover();
  const std::string innocent = add({}, -100);
  EXPECT_EQ(store->claim()->id, first);
  EXPECT_EQ(store->claim()->id, innocent);
  EXPECT_FALSE(store->claim());
  ASSERT_TRUE(store->finish(first, 2, success));
  EXPECT_EQ(store->claim()->id, second);
}

TEST_F(JobStoreTest, APausedQueueStaysPausedAfterARestart) {
  add();
  store->set_queue_paused(true);
  reopen();
  EXPECT_TRUE(store->queue_paused());
  EXPECT_FALSE(store->claim());
  store->set_queue_paused(false);
  EXPECT_TRUE(store->claim());
}

TEST_F(JobStoreTest, ANumberOfAnEventIsNeverGivenAgain) {
  const std::string job = add();
  store->cancel(job);
  const std::uint64_t last = store->last_event({});
  ASSERT_TRUE(store->remove(job));
  EXPECT_EQ(store->last_event({}), last);
  reopen();
  add();
  EXPECT_EQ(store->events({}, 0, 10).at(0).number, last + 1);
}

TEST_F(JobStoreTest, TheIdOfARemovedJobIsNeverGivenAgain) {
  const std::string job = add();
  store->cancel(job);
  ASSERT_TRUE(store->remove(job));
  reopen();
  EXPECT_GT(add(), job);
}

TEST_F(JobStoreTest, TheDatabaseHasAWriteAheadLog) {
  SCULPT_SQLITE_ONLY();
  Database other(file());
  Statement mode(other, "PRAGMA journal_mode");
  ASSERT_TRUE(mode.step());
  EXPECT_EQ(mode.text(0), "wal");
}

}  // namespace
}  // namespace sculpt::server
