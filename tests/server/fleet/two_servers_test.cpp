// Two servers that share a database, with their files in a folder or in the database too: each answers for every job.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <thread>

#include "tests/server/live_server.hpp"
#include "tests/server/test_store.hpp"

namespace sculpt::server {
namespace {

class TwoServers : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    SCULPT_POSTGRES_ONLY();
    first.emplace([](Config& config) {
      config.workers = 1;
      if (!in_folder()) config.shared.clear();
    });
    second.emplace([this](Config& config) {
      config.workers = 1;
      config.store = test_database(first->data());
      config.shared = in_folder() ? first->data() : std::filesystem::path();
    });
    one.emplace(first->connect());
    two.emplace(second->connect());
  }
  static bool in_folder() { return GetParam(); }
  void open_gates() {
    first->fake.gate.open();
    second->fake.gate.open();
  }
  static std::string trajectory(client::Client& client, const std::string& job) {
    std::ostringstream bytes;
    client.read_artifact({job, "trajectory"}, bytes);
    return bytes.str();
  }
  static std::uint64_t files_of(const LiveServer& server, const std::string& job) {
    std::uint64_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(server.data() / "jobs" / job))
      ++count;
    return count;
  }

  std::optional<LiveServer> first, second;
  std::optional<client::Client> one, two;
};

TEST_P(TwoServers, AJobIsKnownEverywhereAndItsFilesAreRead) {
  const std::string job = submit(*one, "plain");
  EXPECT_EQ(final_state(*two, job), "succeeded");
  EXPECT_EQ(final_state(*one, job), "succeeded");
  EXPECT_EQ(trajectory(*one, job), trajectory(*two, job));
  if (in_folder()) {
    EXPECT_EQ(files_of(*first, job), 1u) << "one folder, that of its attempt";
  }
}

TEST_P(TwoServers, ATrajectoryGrowsEverywhereAndItsOtherFormsAreMadeAnywhere) {
  const std::string job = submit(*one, "hold");
  std::string head;
  while (head.empty()) {
    std::ostringstream bytes;
    const bool here = second->fake.runs > 0;
    (here ? *one : *two).read_artifact({job, "trajectory"}, bytes, [] { return false; });
    head = bytes.str();
  }
  open_gates();
  EXPECT_EQ(final_state(*two, job), "succeeded");
  EXPECT_TRUE(trajectory(*one, job).starts_with(head));
  std::ostringstream a, b;
  one->read_artifact({job, "trajectory", "csv"}, a);
  two->read_artifact({job, "trajectory", "csv"}, b);
  EXPECT_EQ(a.str(), b.str());
  EXPECT_FALSE(a.str().empty());
  EXPECT_TRUE(two->call("job.verify", {{"job", job}}).at("clean"));
}

TEST_P(TwoServers, ALinkOfOneIsGoodAtTheOther) {
  const std::string job = submit(*one, "plain");
  ASSERT_EQ(final_state(*one, job), "succeeded");
  const std::string path = one->call("artifact.link", {{"job", job}, {"artifact", "trajectory"}}).at("path");
  client::Connection http(second->address());
  http.send("GET " + path + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  EXPECT_EQ(http.read_line()->substr(0, 12), "HTTP/1.1 200");
}

TEST_P(TwoServers, ADaemonThatKeepsFilesElsewhereIsRefused) {
  EXPECT_THROW(LiveServer([this](Config& config) {
                 config.store = test_database(first->data());
                 if (in_folder()) config.shared.clear();
               }),
               ConfigError);
}

TEST_P(TwoServers, BothWorkAtOnceAndACancelReachesWhoeverHasTheJob) {
  const std::string a = submit(*one, "hold"), b = submit(*one, "hold");
  await_state(*two, a, "running");
  await_state(*two, b, "running");
  while (first->fake.runs + second->fake.runs < 2) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_EQ(first->fake.runs, 1) << "each has one worker";
  one->call("job.cancel", {{"job", a}});
  one->call("job.cancel", {{"job", b}});
  EXPECT_EQ(final_state(*two, a), "cancelled");
  EXPECT_EQ(final_state(*two, b), "cancelled");
}

TEST_P(TwoServers, ADaemonThatStopsHandsItsJobOver) {
  first->fake.gate.open();
  const std::string job = submit(*two, "hold");
  // Whoever took it: the one whose gate is open ends it.
  if (second->fake.runs == 0) await_state(*one, job, "running");
  two.reset();
  second->stop();
  EXPECT_EQ(final_state(*one, job), "succeeded");
}

TEST_P(TwoServers, TheFleetIsShown) {
  Json fleet;
  do fleet = one->call("server.info").at("fleet");
  while (fleet.size() < 2);
  for (const Json& daemon : fleet) {
    EXPECT_EQ(daemon.at("workers"), 1);
    EXPECT_GE(daemon.at("silent_s").get<double>(), 0);
  }
  EXPECT_NE(fleet[0].at("daemon"), fleet[1].at("daemon"));
}

TEST_P(TwoServers, APausedQueueIsPausedForAll) {
  one->call("queue.pause");
  const std::string job = submit(*two, "plain");
  EXPECT_EQ(two->call("job.get", {{"job", job}}).at("state"), "queued");
  EXPECT_TRUE(two->call("server.info").at("queue_paused"));
  two->call("queue.resume");
  EXPECT_EQ(final_state(*one, job), "succeeded");
}

INSTANTIATE_TEST_SUITE_P(Files, TwoServers, testing::Bool(),
                         [](const auto& which) { return which.param ? "InAFolder" : "InTheDatabase"; });

}  // namespace
}  // namespace sculpt::server
