#include "server/run/isolated_run.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <mutex>

#include "server/base/storage_error.hpp"
#include "server/confine/confinement.hpp"
#include "server/files/blobs.hpp"
#include "server/results/isolated_timing.hpp"
#include "server/run/child_process.hpp"
#include "server/run/isolated_check.hpp"
#include "server/run/isolated_examination.hpp"
#include "server/run/isolated_replay.hpp"
#include "server/run/job_run.hpp"
#include "tests/server/fake_planner.hpp"
#include "tests/server/live_server.hpp"
#include "tests/server/temp_folder.hpp"

namespace sculpt::server {
namespace {

// The child is tests/server/worker.
class IsolatedRunTest : public testing::Test {
 protected:
  JobRecord job(const std::string& wish) {
    const std::string mesh = blobs.add(wish);
    JobRecord record;
    record.id = record.folder = "JOB";
    record.cell_bundle = store_cell(fake.planner().read_cell("gantry"), blobs);
    record.spec = R"({"mesh":{"blob":")" + mesh + R"(","name":"wish.stl"},"robot":"gantry","resolution":8})";
    return record;
  }
  Ending run(const std::string& wish, const Watch& watch = {}) {
    return make_isolated_run({FAKE_WORKER, blobs.folder(), folder.path() / "jobs", {}, grace})(job(wish), watch);
  }
  std::string crash(const std::string& wish) {
    try {
      run(wish);
      return "none";
    } catch (const CrashError& error) {
      return error.what();
    }
  }

  TempFolder folder;
  FakePlanner fake;
  Blobs blobs{folder.path() / "blobs", 1 << 20};
  std::chrono::milliseconds grace{10000};

  void SetUp() override {
    std::filesystem::create_directories(blobs.folder());
    std::filesystem::create_directories(folder.path() / "jobs");
  }
};

TEST_F(IsolatedRunTest, AJobEndsAsItWouldHere) {
  const JobDefaults defaults;
  for (const std::string wish : {"plain", "unclean", "prints"}) {
    const Ending there = run(wish);
    const Ending here = make_run_job(fake.planner(), blobs, folder.path() / "here", defaults)(job(wish), {});
    EXPECT_EQ(there.state, here.state) << wish;
    EXPECT_EQ(there.error_sentence, here.error_sentence);
    ASSERT_EQ(there.artifacts.size(), here.artifacts.size());
    for (std::size_t i = 0; i < there.artifacts.size(); ++i) {
      EXPECT_EQ(there.artifacts[i].sha256, here.artifacts[i].sha256);
      EXPECT_EQ(there.artifacts[i].size, here.artifacts[i].size);
    }
  }
}

TEST_F(IsolatedRunTest, WhatTheRunThrowsIsItsEnding) {
  EXPECT_EQ(run("fails").error_code, "no_transit");
  EXPECT_EQ(run("fails").cause, Cause::job);
  EXPECT_EQ(run("no memory").error_code, "out_of_memory");
  EXPECT_EQ(run("no memory").cause, Cause::fault);
  EXPECT_EQ(run("throws").error_code, "internal_error");
}

TEST_F(IsolatedRunTest, AProcessThatDiesIsACrashThatSaysHow) {
  EXPECT_NE(crash("segfault").find("signal 11"), std::string::npos);
  EXPECT_NE(crash("abort").find("signal 6"), std::string::npos);
  EXPECT_NE(crash("exit").find("exit code 0"), std::string::npos);
}

TEST_F(IsolatedRunTest, AProcessThatDiesLeavesNoDraft) {
  const std::filesystem::path draft = folder.path() / "jobs" / "JOB" / "report.json.draft";
  std::filesystem::create_directories(draft.parent_path());
  std::ofstream(draft) << "half of a rep";
  crash("segfault");
  EXPECT_FALSE(std::filesystem::exists(draft));
}

TEST_F(IsolatedRunTest, AStopIsHeardAndTheDeafAreKilled) {
  grace = std::chrono::milliseconds(50);
  for (const std::string wish : {"hold", "deaf"}) {
    std::stop_source stop;
    const Watch watch{stop.get_token(), [&](const Progress& progress) {
                        if (progress.stage == Stage::plan) stop.request_stop();
                      }};
    EXPECT_THROW(run(wish, watch), Cancelled) << wish;
  }
}

// A process that somebody has taken over can say and do what it likes.
TEST_F(IsolatedRunTest, AProcessThatTalksNonsenseIsACrash) {
  const auto run_script = [&](const std::string& line) {
    const std::filesystem::path script = folder.path() / "worker";
    std::ofstream(script) << "#!/bin/sh\ncat >/dev/null\n" << line << "\n";
    std::filesystem::permissions(script, std::filesystem::perms::owner_all);
    make_isolated_run({script, blobs.folder(), folder.path() / "jobs", {}})(job("plain"), {});
  };
  EXPECT_THROW(run_script("echo '{\"progress\":[77,0,0,0]}'"), CrashError);
  EXPECT_THROW(run_script("echo '{\"progress\":[-1,0,0,0]}'"), CrashError);
  EXPECT_THROW(run_script("head -c 3000000 /dev/zero; sleep 1000"), CrashError);
  EXPECT_THROW(run_script("echo no JSON"), std::runtime_error);
}

TEST_F(IsolatedRunTest, AfterASyncThatFailedTheRunStartsOver) {
  const std::filesystem::path script = folder.path() / "worker", files = folder.path() / "jobs" / "JOB";
  std::ofstream(script) << "#!/bin/sh\ncat >/dev/null\nexit 74\n";
  std::filesystem::permissions(script, std::filesystem::perms::owner_all);
  std::filesystem::create_directories(files);
  std::ofstream(files / "checkpoint-0") << "lines that may not be on disk";
  EXPECT_THROW(make_isolated_run({script, blobs.folder(), folder.path() / "jobs", {}})(job("plain"), {}), StorageError);
  EXPECT_FALSE(std::filesystem::exists(files));
}

// Some died of an exception in their hands.
TEST_F(IsolatedRunTest, AProcessWhoseParentIsGoneEndsInOrder) {
  for (const char* option : {run_job_option, check_job_option, check_cell_option, replay_job_option, time_job_option}) {
    for (const std::string said : {"", "{\"daemon\":1"}) {
      ChildProcess child(FAKE_WORKER, option);
      child.send(said);
      EXPECT_EQ(child.wait(), "exit code 1") << option << " after '" << said << "'";
    }
  }
}

TEST_F(IsolatedRunTest, AProcessReachesNothingButTheFilesOfItsJob) {
  const std::vector<std::string> missing = missing_confinement();
  if (under_sanitizer || !missing.empty()) GTEST_SKIP() << "the system does not offer all that confines a process";
  std::ofstream(folder.path() / "tokens.json") << "{}";
  ASSERT_EQ(::setenv("SCULPT_TOKEN", "secret", 1), 0);
  EXPECT_EQ(run("spies").error_sentence, "nothing");
  ::unsetenv("SCULPT_TOKEN");
}

TEST_F(IsolatedRunTest, AProgramThatIsNotThereIsSaidSo) {
  EXPECT_THROW(make_isolated_run({"/nowhere/sculptd", blobs.folder(), folder.path(), {}})(job("plain"), {}),
               std::system_error);
}

TEST(IsolatedJobs, ThoseThatCrashAreQuarantinedAndTheirNeighboursFinish) {
  LiveServer server([](Config& config) {
    config.isolate = true;
    config.retry_backoff = std::chrono::milliseconds(1);
  });
  client::Client client = server.connect();
  std::vector<std::string> poison, sound;
  for (const std::string wish : {"segfault", "abort", "exit"}) {
    poison.push_back(submit(client, wish));
    sound.push_back(submit(client, "plain"));
  }
  for (const std::string& job : poison) {
    EXPECT_EQ(final_state(client, job), "quarantined");
    const Json view = client.call("job.get", {{"job", job}});
    EXPECT_EQ(view.at("attempt"), 2);
    EXPECT_EQ(view.at("error").at("code"), "planner_crashed");
  }
  for (const std::string& job : sound) EXPECT_EQ(final_state(client, job), "succeeded");
  EXPECT_EQ(client.call("job.retry", {{"job", poison[0]}}).at("state"), "queued");
  EXPECT_EQ(final_state(client, poison[0]), "quarantined");
}

}  // namespace
}  // namespace sculpt::server
