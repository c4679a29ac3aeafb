#include "server/job_store.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "proto/error_codes.hpp"
#include "server/sqlite.hpp"
#include "tests/server/temp_folder.hpp"

namespace sculpt {
namespace {

class JobStoreTest : public testing::Test {
 protected:
  std::string add(const std::string& key = {}, int priority = 0, const std::string& spec = "{}") {
    return store->submit({key, priority, spec, "bundle"}).job.id;
  }
  void reopen() {
    store.reset();
    store = open_sqlite_store(file());
  }
  std::filesystem::path file() const { return folder.path() / "sculptd.db"; }
  JobState state(const std::string& job) { return store->find(job)->state; }

  TempFolder folder;
  std::unique_ptr<JobStore> store = open_sqlite_store(file());
};

const Ending success{JobState::succeeded, {}, {}, {{"trajectory", "ndjson", 12, "abc"}, {"report", "json", 3, "def"}}};
const Ending failure{JobState::failed, "no_transit", "there is no way", {}};

std::string error_of(const std::function<void()>& act) {
  try {
    act();
    return "none";
  } catch (const ProtocolError& error) {
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
  std::string after;
  for (std::vector<JobRecord> page = store->list(after, 10); !page.empty(); page = store->list(after, 10)) {
    for (const JobRecord& job : page) listed.push_back(job.id);
    after = listed.back();
  }
  EXPECT_EQ(listed, ids);
}

TEST_F(JobStoreTest, ARepeatedKeyGivesTheFirstJobAndAnotherSpecAConflict) {
  const Submitted first = store->submit({"order-1", 0, "{\"a\":1}", "bundle"});
  EXPECT_FALSE(first.duplicate);
  reopen();
  const Submitted again = store->submit({"order-1", 5, "{\"a\":1}", "other bundle"});
  EXPECT_TRUE(again.duplicate);
  EXPECT_EQ(again.job.id, first.job.id);
  EXPECT_EQ(error_of([&] { store->submit({"order-1", 0, "{\"a\":2}", "bundle"}); }), "key_conflict");
  EXPECT_EQ(store->list({}, 100).size(), 1u);
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

TEST_F(JobStoreTest, RandomHistoriesHaveGaplessEventsThatTellTheStates) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::vector<std::string> jobs{add()};
    for (int step = 0; step < 60; ++step) {
      const std::string& job = jobs[random.next() % jobs.size()];
      const int attempt = store->find(job)->attempt;
      switch (random.next() % 7) {
        case 0:
          jobs.push_back(add({}, static_cast<int>(random.next() % 3)));
          break;
        case 1:
          store->claim();
          break;
        case 2:
          store->finish(job, attempt, random.next() % 2 == 0 ? success : failure);
          break;
        case 3:
          store->release(job, attempt);
          break;
        case 4:
          error_of([&] { store->cancel(job); });
          break;
        case 5:
          store->finish(job, attempt - 1, success);
          break;
        default:
          store->recover();
          break;
      }
    }
    for (const std::string& job : jobs) {
      JobState now = JobState::queued;
      std::uint64_t seq = 0;
      for (const StateEvent& event : store->events(job, 0, 1000)) {
        ASSERT_EQ(event.seq, ++seq);
        const Json data = parse_json(event.data);
        if (seq > 1) {
          ASSERT_EQ(data.at("from"), name(now));
          ASSERT_TRUE(may_move(now, event.to));
        }
        ASSERT_EQ(data.at("to"), name(event.to));
        now = event.to;
      }
      EXPECT_EQ(now, state(job));
      EXPECT_EQ(seq, store->last_event(job));
      EXPECT_EQ(store->events(job, seq - 1, 1000).size(), 1u);
    }
  }
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

TEST_F(JobStoreTest, ADatabaseOfANewerVersionIsRefused) {
  store.reset();
  Database(file()).run("PRAGMA user_version=99");
  EXPECT_THROW(open_sqlite_store(file()), StorageError);
}

TEST_F(JobStoreTest, TheDatabaseHasAWriteAheadLog) {
  Database other(file());
  Statement mode(other, "PRAGMA journal_mode");
  ASSERT_TRUE(mode.step());
  EXPECT_EQ(mode.text(0), "wal");
}

}  // namespace
}  // namespace sculpt
