#include "server/results/retention.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "proto/cell_bundle.hpp"
#include "server/run/inheritance.hpp"
#include "tests/server/live_server.hpp"
#include "tests/server/temp_folder.hpp"
#include "tests/server/test_store.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t hour_ms = 3'600'000;
const RetentionRules generous{std::chrono::hours(1000), 1 << 30};

class RetentionTest : public testing::Test {
 protected:
  RetentionTest() {
    fs::create_directories(blobs.folder());
    fs::create_directories(jobs());
    StoreRules store_rules;
    store_rules.now_ms = [this] { return now; };
    store = open_test_store(folder.path() / "db", store_rules);
    cell = blobs.add(proto::write_cell_bundle({"gantry", "{}", {{"room.urdf", blobs.add("<robot/>")}}}));
  }
  fs::path jobs() const { return folder.path() / "jobs"; }

  /// A job of its own mesh with a result of so many bytes, finished now.
  std::string add(std::size_t bytes) {
    meshes.push_back(blobs.add("mesh " + std::to_string(meshes.size())));
    NewJob job;
    job.spec = R"({"mesh":{"blob":")" + meshes.back() + R"(","name":"a.stl"},"robot":"gantry","resolution":8})";
    job.cell_bundle = cell;
    const std::string id = store->submit(job).job.id;
    fs::create_directories(jobs() / id);
    std::ofstream(jobs() / id / "trajectory.ndjson") << std::string(bytes, 'x');
    return id;
  }
  std::string add_finished(std::size_t bytes) {
    const std::string id = add(bytes);
    const JobRecord claimed = *store->claim();
    EXPECT_EQ(claimed.id, id);
    const StoredArtifact trajectory{"trajectory", "ndjson", bytes, {}};
    store->finish(id, claimed.attempt, {JobState::succeeded, {}, {}, {trajectory}, Cause::job});
    return id;
  }
  std::vector<std::string> sweep(const RetentionRules& rules) {
    const Isolation isolation{};
    const Programs programs(blobs, isolation);
    const MachinedFiles machined(blobs, isolation);
    const Artifacts artifacts(JobFiles(jobs()), *store, planner, programs, machined);
    return Retention(*store, blobs, artifacts).sweep(rules, now);
  }

  TempFolder folder;
  std::uint64_t now = 1'700'000'000'000;
  const Planner planner;
  Blobs blobs{folder.path() / "blobs", 1 << 20};
  std::unique_ptr<JobStore> store;
  std::string cell;
  std::vector<std::string> meshes;
};

TEST_F(RetentionTest, FinishedJobsGoByAgeAndThoseThatWaitStay) {
  const std::string old = add_finished(10);
  now += 2 * hour_ms;
  const std::string young = add_finished(10), waiting = add(10);
  now += hour_ms;
  EXPECT_EQ(sweep({std::chrono::hours(2), 1000, std::chrono::hours(24)}), std::vector{old});
  EXPECT_FALSE(store->find(old));
  EXPECT_TRUE(store->was_removed(old));
  EXPECT_EQ(store->last_event(old), 0u);
  EXPECT_FALSE(fs::exists(jobs() / old));
  for (const std::string& kept : {young, waiting}) {
    EXPECT_TRUE(store->find(kept));
    EXPECT_TRUE(fs::exists(jobs() / kept));
  }
}

TEST_F(RetentionTest, TheOldestGoWhenThereIsTooMuchAndPinnedOnesNever) {
  const std::string pinned = add_finished(100);
  now += hour_ms;
  const std::string second = add_finished(100);
  now += hour_ms;
  const std::string third = add_finished(100);
  store->pin(pinned, true);
  const RetentionRules rules{std::chrono::hours(1000), 200, std::chrono::hours(24)};
  EXPECT_EQ(sweep(rules), std::vector{second});
  EXPECT_TRUE(sweep(rules).empty());
  store->pin(pinned, false);
  EXPECT_EQ(sweep({std::chrono::hours(1000), 100, std::chrono::hours(24)}), std::vector{pinned});
  EXPECT_TRUE(store->find(third));
}

TEST_F(RetentionTest, ACrashBetweenRowAndFilesLeavesNothingForLong) {
  const std::string job = add_finished(10);
  ASSERT_TRUE(store->remove(job));
  sweep(generous);
  EXPECT_FALSE(fs::exists(jobs() / job));
}

// An emptied database once took all results with it, without a word.
TEST_F(RetentionTest, AFolderOfNoKnownJobIsPutAsideAndNeverDeleted) {
  const std::string known = add_finished(10);
  for (int time = 0; time < 2; ++time) {
    fs::create_directories(jobs() / "01M7XRMDB8NWM1BF9DPP1KFA0R");
    std::ofstream(jobs() / "01M7XRMDB8NWM1BF9DPP1KFA0R" / "trajectory.ndjson") << "a result";
    sweep(generous);
  }
  EXPECT_TRUE(fs::exists(jobs() / known));
  EXPECT_FALSE(fs::exists(jobs() / "01M7XRMDB8NWM1BF9DPP1KFA0R"));
  EXPECT_TRUE(fs::exists(folder.path() / "jobs.orphaned/01M7XRMDB8NWM1BF9DPP1KFA0R/trajectory.ndjson"));
  EXPECT_TRUE(fs::exists(folder.path() / "jobs.orphaned/01M7XRMDB8NWM1BF9DPP1KFA0R.2/trajectory.ndjson"));
}

TEST_F(RetentionTest, BlobsStayWhileAJobNeedsThemOrTheyWereJustUsed) {
  const std::string job = add(10);
  const std::string stray = blobs.add("nobody needs this");
  sweep(generous);
  EXPECT_TRUE(blobs.state(stray).complete) << "somebody may be about to submit it";
  const RetentionRules at_once{std::chrono::hours(1), 1000, std::chrono::seconds(-1)};
  sweep(at_once);
  EXPECT_FALSE(blobs.state(stray).complete);
  EXPECT_TRUE(blobs.state(meshes[0]).complete);
  EXPECT_TRUE(blobs.state(cell).complete);
  store->cancel(job);
  ASSERT_TRUE(store->remove(job));
  sweep(at_once);
  EXPECT_FALSE(blobs.state(meshes[0]).complete);
  EXPECT_FALSE(blobs.state(cell).complete);
}

TEST_F(RetentionTest, WhatAJobInheritedStaysAsLongAsTheJob) {
  const std::string left = blobs.add("what another left");
  proto::JobSpec spec;
  spec.mesh = {blobs.add("mesh"), "a.stl"};
  spec.robot = "gantry";
  NewJob job;
  job.inherited = inherited_text(spec, {left, {}});
  spec.continued = proto::ContinueSpec{"j", {}};
  job.spec = proto::write_json(to_json(spec));
  job.cell_bundle = cell;
  const std::string id = store->submit(job).job.id;
  const RetentionRules at_once{std::chrono::hours(1), 1000, std::chrono::seconds(-1)};
  sweep(at_once);
  EXPECT_TRUE(blobs.state(left).complete);
  store->cancel(id);
  ASSERT_TRUE(store->remove(id));
  sweep(at_once);
  EXPECT_FALSE(blobs.state(left).complete);
}

TEST(Retention, ARemovedJobIsGoneAndAPinnedOneSaysSo) {
  LiveServer server([](Config& config) { config.keep = std::chrono::seconds(1000); });
  client::Client client = server.connect();
  const std::string job = submit(client, "plain");
  EXPECT_EQ(final_state(client, job), "succeeded");
  EXPECT_TRUE(client.call("job.get", {{"job", job}}).contains("expires_at"));
  EXPECT_EQ(client.call("artifact.pin", {{"job", job}}), (Json{{"job", job}, {"pinned", true}}));
  EXPECT_EQ(client.call("job.get", {{"job", job}}).at("pinned"), true);
  EXPECT_EQ(client.call("artifact.pin", {{"job", job}, {"pinned", false}}).at("pinned"), false);
  server.stop();
  const std::filesystem::path file = test_in_postgres() ? server.data() : server.data() / "sculptd.db";
  ASSERT_TRUE(open_test_store(file)->remove(job));
  server.restart();
  client::Client again = server.connect();
  EXPECT_EQ(refusal(again, "job.get", {{"job", job}}), "gone");
  EXPECT_EQ(refusal(again, "job.get", {{"job", "nobody"}}), "not_found");
}

}  // namespace
}  // namespace sculpt::server
