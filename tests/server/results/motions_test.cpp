// Windows of a motion, what is kept of it, and what becomes of a time law that is not found.
#include "server/results/motions.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <thread>

#include "core/base/sha256.hpp"
#include "proto/cell_bundle.hpp"
#include "server/base/storage_error.hpp"
#include "tests/server/fake_motion.hpp"
#include "tests/server/temp_folder.hpp"
#include "tests/server/test_store.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t row_bytes = 2 * sizeof(double);

class MotionsTest : public testing::Test {
 protected:
  MotionsTest() {
    fs::create_directories(blobs.folder());
    fs::create_directories(jobs());
    isolation.worker = FAKE_WORKER;
    isolation.blobs = blobs.folder();
    isolation.jobs = jobs();
    job = add(8);
  }
  fs::path jobs() const { return folder.path() / "jobs"; }

  JobRecord add(int moves) {
    NewJob wanted;
    wanted.spec = R"({"mesh":{"blob":")" + blobs.add("moves") + R"(","name":"a.stl"},"robot":"gantry","resolution":8})";
    wanted.cell_bundle = blobs.add(proto::write_cell_bundle({"gantry", "{}", {}}));
    const std::string id = store->submit(wanted).job.id;
    const JobRecord claimed = *store->claim();
    const std::string plan = fake_motion(moves);
    fs::create_directories(jobs() / claimed.folder);
    std::ofstream(jobs() / claimed.folder / "trajectory.ndjson") << plan;
    const StoredArtifact trajectory{"trajectory", "ndjson", plan.size(), sha256_hex(plan)};
    store->finish(id, claimed.attempt, {JobState::succeeded, {}, {}, {trajectory}, Cause::job});
    return *store->find(id);
  }
  static proto::SamplesParams at_feed(double feed_m_s) {
    proto::SamplesParams wanted;
    wanted.motion.feed_m_s = feed_m_s;
    wanted.rate_hz = 10;
    return wanted;
  }
  SampleWindow window(Motions& of, const proto::SamplesParams& wanted, std::size_t bytes = 1 << 20) {
    return of.window(job, wanted, bytes, {});
  }
  template <class Error>
  std::string refusal(double feed_m_s) {
    try {
      window(motions, at_feed(feed_m_s));
      return "accepted";
    } catch (const Error& error) {
      EXPECT_FALSE(fs::exists(jobs() / job.folder / "motion.law")) << "it would be taken for another one's";
      return error.what();
    }
  }
  static double value(const SampleWindow& window, std::size_t sample, std::size_t column) {
    double read = 0;
    std::memcpy(&read, window.rows.data() + sample * row_bytes + column * sizeof(double), sizeof read);
    return read;
  }

  TempFolder folder;
  const Planner planner;
  Blobs blobs{folder.path() / "blobs", 1 << 20};
  std::unique_ptr<JobStore> store = open_test_store(folder.path() / "db");
  Isolation isolation;
  Programs programs{blobs, isolation};
  MachinedFiles machined{blobs, isolation};
  Artifacts artifacts{JobFiles(jobs()), *store, planner, programs, machined};
  Motions motions{artifacts, blobs, isolation};
  JobRecord job;
};

TEST_F(MotionsTest, AWindowIsAPieceOfTheWholeMotion) {
  const SampleWindow all = window(motions, at_feed(1));
  EXPECT_EQ(all.joints, std::vector<std::string>{"x"});
  EXPECT_EQ(all.first, 0u);
  EXPECT_EQ(all.count, all.samples);
  EXPECT_EQ(all.rows.size(), all.count * row_bytes);
  EXPECT_EQ(value(all, 0, 0), 0);
  EXPECT_NEAR(value(all, all.count - 1, 0), 0, 1e-12) << "eight moves end where they began";
  EXPECT_NEAR(value(all, all.count - 1, 1), 0, 1e-12) << "at rest";
  proto::SamplesParams some = at_feed(1);
  some.from_s = 1;
  some.to_s = 2;
  const SampleWindow piece = window(motions, some);
  EXPECT_EQ(piece.first, 10u);
  EXPECT_EQ(piece.count, 11u);
  EXPECT_TRUE(piece.rows == all.rows.substr(10 * row_bytes, 11 * row_bytes));
  EXPECT_EQ(window(motions, some, 3 * row_bytes + 1).count, 3u) << "as many as fit";
  EXPECT_EQ(window(motions, some, 1).count, 1u) << "and at least one";
  some.from_s = all.duration_s + 1;
  some.to_s = {};
  EXPECT_THROW(window(motions, some), proto::ProtocolError);
}

TEST_F(MotionsTest, AHoldIsThatOfItsWindowAlone) {
  const SampleWindow before = window(motions, at_feed(1));
  proto::SamplesParams held = at_feed(1);
  held.holds_s = {0.5};
  const SampleWindow with = window(motions, held);
  ASSERT_EQ(with.holds.size(), 1u);
  EXPECT_GT(with.samples, before.samples);
  held.holds_s = {2, 1};
  EXPECT_THROW(window(motions, held), InputError);
  EXPECT_TRUE(window(motions, at_feed(1)).rows == before.rows) << "nothing of it is left";
}

TEST_F(MotionsTest, WhatIsKeptHasALimitButForTheLastOne) {
  window(motions, at_feed(1));
  window(motions, at_feed(2));
  EXPECT_TRUE(motions.has(job, at_feed(1)));
  EXPECT_TRUE(motions.has(job, at_feed(2)));
  EXPECT_FALSE(motions.has(job, at_feed(3)));
  Motions small(artifacts, blobs, isolation, 1);
  window(small, at_feed(1));
  EXPECT_TRUE(small.has(job, at_feed(1)));
  window(small, at_feed(2));
  EXPECT_FALSE(small.has(job, at_feed(1)));
  EXPECT_TRUE(small.has(job, at_feed(2)));
}

TEST_F(MotionsTest, AJobThatWasPlannedAgainHasAnotherMotion) {
  window(motions, at_feed(1));
  JobRecord again = job;
  again.folder += "/2";
  EXPECT_FALSE(motions.has(again, at_feed(1)));
}

TEST_F(MotionsTest, NobodyWaitsForAnothersLaw) {
  const SampleWindow before = window(motions, at_feed(1));
  std::stop_source stop;
  std::jthread finding(
      [&] { EXPECT_THROW(motions.window(job, at_feed(feed_endless), 1, stop.get_token()), Cancelled); });
  EXPECT_TRUE(window(motions, at_feed(1)).rows == before.rows);
  stop.request_stop();
}

TEST_F(MotionsTest, WhatStopsTheProcessThatFindsTheLawIsSaid) {
  EXPECT_EQ(refusal<InputError>(feed_refused), "no such feed");
  EXPECT_NE(refusal<std::runtime_error>(feed_crashes).find("the process that timed the job ended with signal"),
            std::string::npos);
  EXPECT_NE(refusal<StorageError>(feed_writes_none).find("left no time law"), std::string::npos);
  EXPECT_NE(refusal<StorageError>(feed_of_another_plan).find("not that of its trajectory"), std::string::npos);
  EXPECT_GT(window(motions, at_feed(1)).samples, 1u) << "and the next one is found";
}

TEST_F(MotionsTest, ALawThatTakesTooLongIsGivenUp) {
  isolation.result_time = std::chrono::milliseconds(200);
  EXPECT_NE(refusal<InputError>(feed_endless).find("result_s"), std::string::npos);
}

TEST_F(MotionsTest, OfADamagedTrajectoryThereIsNone) {
  std::ofstream(jobs() / job.folder / "trajectory.ndjson") << fake_motion(6);
  EXPECT_NE(refusal<proto::ProtocolError>(1).find("damaged"), std::string::npos);
}

}  // namespace
}  // namespace sculpt::server
