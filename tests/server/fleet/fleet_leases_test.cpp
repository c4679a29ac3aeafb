// Who holds a job, and who takes it.
#include "server/fleet/fleet_leases.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "tests/server/fleet/fleet_store_fixture.hpp"

namespace sculpt::server {
namespace {

using enum JobState;

TEST_F(FleetStoreTest, AJobOfASilentDaemonIsTakenAndItsLateEndRefused) {
  const std::string job = add(*first);
  ASSERT_EQ(first->claim()->attempt, 1);
  EXPECT_TRUE(second->wake_due().empty()) << "its lease is good";
  end_all_leases();
  EXPECT_EQ(second->wake_due(), std::vector{job});
  const JobRecord taken = *second->claim();
  EXPECT_EQ(taken.attempt, 2);
  EXPECT_EQ(taken.folder, job + "/2") << "where the run that lost it does not write";
  EXPECT_FALSE(first->finish(job, 1, success));
  EXPECT_FALSE(first->release(job, 1));
  EXPECT_EQ(first->late_ends(), 2u);
  EXPECT_TRUE(second->finish(job, 2, success));
  EXPECT_EQ(first->find(job)->state, succeeded);
}

TEST_F(FleetStoreTest, ADaemonThatIsStartedAgainReleasesItsOwnJobsAndNoOthers) {
  const std::string mine = add(*first);
  first->claim();
  const std::string others = add(*first);
  second->claim();
  first = open("first");
  EXPECT_EQ(first->recover(), 1);
  EXPECT_EQ(first->find(mine)->state, queued);
  EXPECT_EQ(first->find(others)->state, running);
}

// A commit waits for a standby that is not there: the database has stored it, and its answer is cut off.
TEST_F(FleetStoreTest, AClaimThatWasStoredAndNotAnsweredIsGivenBackAtTheNext) {
  const std::string job = add(*first), next = add(*first);
  const std::string others = second->claim()->id;
  ASSERT_EQ(others, job);
  const auto set_standby = [&](const std::string& names) {
    other->ask({"ALTER SYSTEM SET synchronous_standby_names='" + names + "'"});
    other->ask({"SELECT pg_reload_conf()"});
  };
  set_standby("nobody");
  const auto cut_off = [&] {
    return other
               ->ask({"SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE wait_event='SyncRep' AND "
                      "datname=current_database()"})
               .rows() > 0;
  };
  // Commits wait as soon as the checkpointer has read the settings, which nobody else can see.
  Postgres any({test_database(file), {}}, std::chrono::seconds(30));
  std::thread committing([&any] {
    EXPECT_THROW(while (true) any.ask({"SELECT pg_logical_emit_message(true, 'test', '')"}), DatabaseUnavailable);
  });
  await(cut_off);
  committing.join();
  std::thread claiming([this] { EXPECT_THROW(first->claim(), DatabaseUnavailable); });
  await(cut_off);
  set_standby("");
  claiming.join();
  ASSERT_EQ(second->find(next)->state, running) << "the commit itself was done";
  const std::optional<JobRecord> again = first->claim();
  ASSERT_TRUE(again);
  EXPECT_EQ(again->id, next);
  EXPECT_EQ(again->attempt, 2);
  EXPECT_FALSE(again->isolated) << "it is not suspected: nothing crashed";
  EXPECT_EQ(first->find(others)->state, running) << "another daemon's is left alone";
  EXPECT_TRUE(first->finish(next, 2, success));
}

TEST_F(FleetStoreTest, ALeaseIsRenewedWhileItsDaemonLives) {
  first = open("third", {}, std::chrono::seconds(3));
  const std::string job = add(*first);
  first->claim();
  const auto until = [&] { return other->ask({"SELECT until FROM sculptd.lease"}).text(0, 0); };
  const std::string at_first = until();
  FleetHooks hooks = quiet();
  hooks.progress = [](const std::string&) { return Progress{Stage::plan, 3, 7}; };
  first->join("here:1", hooks);
  second->join("here:2", quiet());
  await([&] { return until() > at_first; });
  await([&] { return second->progress(job).has_value(); });
  EXPECT_EQ(second->progress(job)->done, 3u) << "any daemon knows how far it is";
  first->leave();
  second->leave();
  EXPECT_TRUE(first->finish(job, 1, success));
}

TEST_F(FleetStoreTest, WhoeverLosesItsLeaseEndsTheRun) {
  first = open("third", {}, std::chrono::seconds(3));
  const std::string job = add(*first);
  first->claim();
  std::atomic<int> lost = 0;
  FleetHooks hooks = quiet();
  hooks.lost = [&](const std::string& which) { lost += which == job; };
  first->join("here:1", hooks);
  end_all_leases();
  second->wake_due();
  await([&] { return lost > 0 || first->find(job)->state == running; });
  if (first->find(job)->state == queued) await([&] { return lost > 0; });
  first->leave();
  EXPECT_EQ(first->leases_lost(), static_cast<std::uint64_t>(lost));
}

}  // namespace
}  // namespace sculpt::server
