// Several daemons over one database.
#include "server/fleet/fleet_store.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <set>
#include <thread>

#include "proto/error_codes.hpp"
#include "server/base/config.hpp"
#include "server/fleet/fleet_schema.hpp"
#include "tests/server/fleet/fleet_store_fixture.hpp"

namespace sculpt::server {
namespace {

using enum JobState;

TEST_F(FleetStoreTest, EachJobIsClaimedOnce) {
  constexpr int jobs = 200;
  for (int i = 0; i < jobs; ++i) add(i % 2 == 0 ? *first : *second);
  std::mutex mutex;
  std::multiset<std::string> claimed;
  const auto is_queued = [](const JobRecord& job) { return job.state == queued; };
  const auto claim_all = [&](FleetStore& store) {
    while (true) {
      const std::optional<JobRecord> job = store.claim();
      // Rows that the others are looking at are passed over, so nothing may mean a little later.
      if (!job && std::ranges::none_of(store.list({.limit = 1000}).jobs, is_queued)) return;
      if (!job) continue;
      ASSERT_TRUE(store.finish(job->id, job->attempt, success));
      const std::lock_guard lock(mutex);
      claimed.insert(job->id);
    }
  };
  {
    std::jthread one([&] { claim_all(*first); }), two([&] { claim_all(*second); });
  }
  EXPECT_EQ(claimed.size(), static_cast<std::size_t>(jobs));
  EXPECT_EQ(std::set<std::string>(claimed.begin(), claimed.end()).size(), static_cast<std::size_t>(jobs));
}

TEST_F(FleetStoreTest, AFollowerMissesNoEventWhoeverWrites) {
  std::atomic<int> writers = 2;
  const auto write = [&](FleetStore& store) {
    for (int i = 0; i < 60; ++i) store.cancel(add(store));
    --writers;
  };
  std::vector<std::uint64_t> seen;
  {
    std::jthread one([&] { write(*first); }), two([&] { write(*second); });
    const std::unique_ptr<FleetStore> reader = open("reader");
    while (true) {
      const bool last = writers == 0;
      for (const StateEvent& event : reader->events({}, seen.empty() ? 0 : seen.back(), 7))
        seen.push_back(event.number);
      if (last && seen.size() >= 240) break;
      ASSERT_LE(seen.size(), 240u);
      if (last && reader->events({}, seen.back(), 7).empty()) break;
    }
  }
  EXPECT_EQ(seen.size(), 240u) << "one that was passed over never came";
  EXPECT_TRUE(std::ranges::is_sorted(seen));
}

TEST_F(FleetStoreTest, WhatOthersDoIsToldAndCounted) {
  std::mutex mutex;
  std::vector<std::string> told;
  FleetHooks hooks = quiet();
  hooks.changed = [&](const std::string& job, JobState to) {
    const std::lock_guard lock(mutex);
    told.push_back(job + " " + name(to));
  };
  const std::string before = add(*second);
  first->join("here:1", hooks);
  const std::string job = add(*second), mine = add(*first);
  second->cancel(job);
  await([&] {
    const std::lock_guard lock(mutex);
    return !told.empty() && told.back() == job + " cancelled";
  });
  EXPECT_EQ(first->counts().at(cancelled), 1u);
  EXPECT_EQ(first->counts().at(queued), 2u);
  EXPECT_EQ(first->position(*first->find(mine)), 1u);
  ASSERT_TRUE(second->remove(job));
  await([&] { return first->counts().at(cancelled) == 0; });
  first->leave();
  for (const std::string& line : told) EXPECT_EQ(line.find(mine), std::string::npos) << "that it did itself is no news";
}

TEST_F(FleetStoreTest, OneKeyIsOneJobWhereverItIsSubmitted) {
  std::vector<std::string> jobs(8);
  {
    std::vector<std::jthread> clients;
    for (std::size_t i = 0; i < jobs.size(); ++i)
      clients.emplace_back([&, i] { jobs[i] = add(i % 2 == 0 ? *first : *second, "order-1"); });
  }
  EXPECT_EQ(std::set<std::string>(jobs.begin(), jobs.end()).size(), 1u);
}

TEST_F(FleetStoreTest, IdsRiseWhoeverGivesThem) {
  std::string last;
  for (int i = 0; i < 40; ++i) {
    const std::string id = add(i % 2 == 0 ? *first : *second);
    EXPECT_GT(id, last);
    last = id;
  }
}

TEST_F(FleetStoreTest, AJobThatNeverHasRoomHereIsLeftToWhoHasIt) {
  StoreRules small, large;
  small.memory_bytes = 10;
  large.memory_bytes = 100;
  first = open("small", small);
  second = open("large", large);
  const std::string big = add(*first, {}, 50), little = add(*first, {}, 5);
  EXPECT_EQ(first->claim()->id, big) << "as long as no other is known to have room, it is tried here";
  ASSERT_TRUE(first->release(big, 1));
  second->join("here:2", quiet());
  await([&] { return first->daemons().size() == 1; });
  EXPECT_EQ(first->claim()->id, little);
  EXPECT_EQ(second->claim()->id, big);
  second->leave();
}

TEST_F(FleetStoreTest, AJobGoesToADaemonThatServesItsQueue) {
  StoreRules large;
  large.queues = {"large", "huge"};
  second = open("large", large);
  const auto add_to = [](FleetStore& store, const std::string& queue) {
    NewJob job;
    job.spec = "{}";
    job.schedule.queue = queue;
    return store.submit(job).job.id;
  };
  const std::string big = add_to(*second, "large"), huge = add_to(*second, "huge"), plain = add_to(*first, "default");
  EXPECT_THROW(add_to(*first, "large"), proto::ProtocolError) << "it has not heard of the other yet";
  second->join("here:2", quiet());
  await([&] { return first->daemons().size() == 1; });
  EXPECT_EQ(first->daemons().front().queues, large.queues);
  const std::string bigger = add_to(*first, "large");
  EXPECT_EQ(first->position(*first->find(bigger)), 1u);
  EXPECT_EQ(first->claim()->id, plain);
  EXPECT_FALSE(first->claim()) << "the rest is for the other";
  EXPECT_EQ(second->claim()->id, big) << "of several queues the one that comes first";
  EXPECT_EQ(second->claim()->id, huge);
  EXPECT_EQ(second->claim()->id, bigger);
  EXPECT_FALSE(second->claim());
  second->leave();
}

TEST_F(FleetStoreTest, WhatIsDueAtOnceIsQueuedInParts) {
  constexpr int jobs = 1200;
  other->ask(
      {"INSERT INTO sculptd.job(id, state, priority, not_before, start_by, max_runtime_s, spec, cell_bundle, "
       "memory_bytes, rank, wake_at, submitted_at, owner, inherited) SELECT lpad(n::text, 26, '0'), 'held', 0, '', '', "
       "0, '{}', '', 1, n, '2020-01-01T00:00:00.000Z', '2020-01-01T00:00:00.000Z', '', '' FROM generate_series(1, $1) "
       "AS n",
       {sql_value(jobs)}});
  first = open("first");
  std::size_t woken = 0, most = 0;
  for (std::vector<std::string> part = first->wake_due(); !part.empty(); part = first->wake_due()) {
    most = std::max(most, part.size());
    woken += part.size();
  }
  EXPECT_EQ(woken, static_cast<std::size_t>(jobs));
  EXPECT_LE(most, 500u) << "one transaction of a whole night's jobs would outlast its time, again and again";
  EXPECT_EQ(first->counts().at(queued), static_cast<std::uint64_t>(jobs));
}

TEST_F(FleetStoreTest, TablesOfANewerVersionAreLeftAlone) {
  add(*first);
  other->ask({"UPDATE sculptd.meta SET value='99' WHERE name='schema'"});
  EXPECT_FALSE(first->claim());
  EXPECT_NE(first->why_idle().find("update it"), std::string::npos);
  EXPECT_THROW(open("late"), StorageError);
  other->ask({"UPDATE sculptd.meta SET value='2' WHERE name='schema'"});
  EXPECT_TRUE(first->claim());
}

TEST_F(FleetStoreTest, DaemonsThatBeginTogetherMakeTheTablesOnce) {
  const std::filesystem::path fresh = folder.path() / "fresh";
  test_database(fresh);
  std::vector<std::string> epochs(4);
  std::vector<std::string> names{"a", "b", "c", "d"};
  std::vector<FleetRules> rules;
  for (const std::string& name : names)
    rules.push_back({{test_database(fresh), {}}, {name, 1, 0}, std::chrono::seconds(30)});
  {
    std::vector<std::jthread> daemons;
    for (std::size_t i = 0; i < epochs.size(); ++i)
      daemons.emplace_back([&, i] { epochs[i] = open_fleet_store(rules[i])->epoch(); });
  }
  EXPECT_EQ(std::set<std::string>(epochs.begin(), epochs.end()).size(), 1u);
}

TEST_F(FleetStoreTest, TextThatTheDatabaseCannotHoldIsMadeSo) {
  const std::string job = add(*first);
  first->claim();
  const std::string bad("mesh \xff\0 broken", 15);
  ASSERT_TRUE(first->finish(job, 1, {failed, "mesh_unreadable", bad, {}, Cause::job}));
  EXPECT_NE(first->find(job)->error_sentence.find("broken"), std::string::npos);
}

TEST_F(FleetStoreTest, AConnectionThatWasCutIsMadeAnewAndLosesNothing) {
  const std::string job = add(*first);
  const auto cut = [&] {
    other->ask(
        {"SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE datname=current_database() AND pid<>"
         "pg_backend_pid()"});
  };
  cut();
  EXPECT_EQ(first->find(job)->state, queued);
  cut();
  ASSERT_TRUE(first->claim());
  cut();
  EXPECT_TRUE(first->finish(job, 1, success));
  cut();
  EXPECT_EQ(first->find(job)->state, succeeded);
}

TEST_F(FleetStoreTest, ADaemonNeedsNoRightToMakeTables) {
  const std::string role = "daemon_" + std::to_string(::getpid());
  other->run("CREATE ROLE " + role + " LOGIN;");
  grant_to_daemons({test_database(file), {}}, role);
  std::string url = test_database(file);
  url.replace(url.find("user=sculptd"), std::string("user=sculptd").size(), "user=" + role);
  {
    const auto store = open_fleet_store({{url, {}}, {"least", 1, 0}, std::chrono::seconds(30)});
    store->join("here:1", quiet());
    const std::string job = add(*store);
    ASSERT_TRUE(store->claim());
    EXPECT_TRUE(store->finish(job, 1, success));
    await([&] { return !first->daemons().empty() && store->sweeps(); });
    EXPECT_TRUE(store->remove(job));
  }
  other->run("DROP OWNED BY " + role + "; DROP ROLE " + role + ";");
}

TEST(Postgres, ADatabaseThatIsNotThereIsUnavailableNow) {
  SCULPT_POSTGRES_ONLY();
  Postgres nowhere({"postgresql:///none?host=/nowhere", {}}, std::chrono::seconds(1));
  EXPECT_THROW(nowhere.ask({"SELECT 1"}), DatabaseUnavailable);
}

TEST(WithoutPassword, HidesItAndLeavesTheRest) {
  EXPECT_EQ(without_password("postgresql://me:secret@host/db?sslmode=require"),
            "postgresql://me:***@host/db?sslmode=require");
  EXPECT_EQ(without_password("postgresql://me@host/db"), "postgresql://me@host/db");
  EXPECT_EQ(without_password("postgresql:///db?host=/run&password=a%20b&user=me"),
            "postgresql:///db?host=/run&password=***&user=me");
}

}  // namespace
}  // namespace sculpt::server
