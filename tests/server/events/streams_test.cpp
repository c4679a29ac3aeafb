// Events and readers that do not keep up.
#include <gtest/gtest.h>

#include <sstream>

#include "server/store/sqlite/sqlite.hpp"
#include "tests/server/live_server.hpp"
#include "tests/server/test_store.hpp"

namespace sculpt::server {
namespace {

TEST(Streams, ProgressComesWhileAJobRunsAndCarriesNoSeq) {
  LiveServer live;
  client::Client client = live.connect();
  const std::string job = submit(client, "hold");
  client.subscribe(job);
  int progress = 0;
  while (progress < 3) {
    const Json event = *client.next_event();
    if (event.at("type") != "progress") continue;
    EXPECT_FALSE(event.contains("seq"));
    EXPECT_EQ(event.at("data"), Json({{"stage", "plan"}, {"done", 1}, {"total", 2}}));
    ++progress;
  }
  EXPECT_EQ(client.call("job.get", {{"job", job}}).at("progress").at("stage"), "plan");
}

TEST(Streams, ALateSubscriberGetsTheWholeStoryOrTheRestOfIt) {
  LiveServer live;
  client::Client client = live.connect();
  const std::string job = submit(client, "plain");
  ASSERT_EQ(final_state(client, job), "succeeded");
  for (std::uint64_t after = 0; after <= 3; ++after) {
    client.subscribe(job, after);
    for (std::uint64_t seq = after + 1; seq <= 3; ++seq) EXPECT_EQ(client.next_event()->at("seq"), seq);
    EXPECT_EQ(client.next_event()->at("type"), "live");
  }
  EXPECT_EQ(refusal(client, "events.subscribe", {{"job", job}, {"after", 4}}), "replay_gap");
}

TEST(Streams, AfterUnsubscribingNothingMoreComes) {
  LiveServer live;
  client::Client client = live.connect();
  const std::string job = submit(client, "hold");
  client.subscribe(job);
  client.unsubscribe(job);
  client.call("job.cancel", {{"job", job}});
  EXPECT_EQ(final_state(client, job), "cancelled");
  EXPECT_FALSE(client.next_event(0.0));
}

TEST(Streams, TwentySubscribersThatNeverReadHarmNobody) {
  LiveServer live;
  client::Client honest = live.connect();
  std::vector<std::string> jobs;
  for (int i = 0; i < 10; ++i) jobs.push_back(submit(honest, "hold"));
  std::vector<std::unique_ptr<client::Client>> silent;
  for (int i = 0; i < 20; ++i) {
    silent.push_back(std::make_unique<client::Client>(live.address(), "silent"));
    for (const std::string& job : jobs) silent.back()->subscribe(job);
  }
  live.fake.gate.open();
  for (const std::string& job : jobs) EXPECT_EQ(final_state(honest, job), "succeeded");
  silent.resize(10);  // half of them vanish
  EXPECT_EQ(final_state(honest, submit(honest, "plain")), "succeeded");
}

// The job, state and number of the next state event of a subscription to all jobs; or live.
std::string next_of_all(client::Client& client, std::uint64_t& number) {
  const Json event = *client.next_event();
  if (event.at("type") == "live") return event.contains("job") ? "live of a job" : "live";
  EXPECT_GT(event.at("number"), number);
  number = event.at("number");
  return event.at("job").get<std::string>() + " " + event.at("data").at("to").get<std::string>();
}

TEST(Streams, OneSubscriptionTellsTheStatesOfAllJobs) {
  LiveServer live;
  client::Client client = live.connect(), watcher = live.connect();
  const std::string before = submit(client, "plain");
  ASSERT_EQ(final_state(client, before), "succeeded");
  std::uint64_t number = 0;
  watcher.subscribe_all();
  for (const char* state : {"queued", "running", "succeeded"})
    EXPECT_EQ(next_of_all(watcher, number), before + " " + state);
  EXPECT_EQ(next_of_all(watcher, number), "live");
  const std::string held = submit(client, "hold");
  EXPECT_EQ(next_of_all(watcher, number), held + " queued");
  EXPECT_EQ(next_of_all(watcher, number), held + " running");
  client.call("job.cancel", {{"job", held}});
  EXPECT_EQ(next_of_all(watcher, number), held + " cancelling");
  EXPECT_EQ(next_of_all(watcher, number), held + " cancelled");
  const std::string after = submit(client, "plain");
  EXPECT_EQ(next_of_all(watcher, number), after + " queued") << "it does not end with a job";
  EXPECT_EQ(refusal(watcher, "events.subscribe", {{"after", 1000}}), "replay_gap");
}

TEST(Streams, OneToAllIsToldOfAJobThatOnlyWaits) {
  LiveServer live;
  client::Client client = live.connect(), watcher = live.connect();
  client.call("queue.pause");
  std::uint64_t number = 0;
  watcher.subscribe_all();
  EXPECT_EQ(next_of_all(watcher, number), "live");
  const std::string job = submit(client, "plain");
  EXPECT_EQ(next_of_all(watcher, number), job + " queued");
}

TEST(Streams, WhoListsAndThenSubscribesMissesNothing) {
  LiveServer live;
  client::Client client = live.connect();
  const std::string first = submit(client, "plain");
  ASSERT_EQ(final_state(client, first), "succeeded");
  const Json list = client.list({.newest = true});
  ASSERT_EQ(list.at("jobs").size(), 1u);
  const std::string second = submit(client, "plain");
  std::uint64_t number = list.at("last");
  client.subscribe_all(number);
  EXPECT_EQ(next_of_all(client, number), second + " queued");
}

TEST(Streams, TheSubscriptionToAllGoesOnBehindARestart) {
  LiveServer live;
  std::uint64_t number = 0;
  std::string job;
  {
    client::Client client = live.connect();
    job = submit(client, "hold");
    client.subscribe_all();
    EXPECT_EQ(next_of_all(client, number), job + " queued");
    client::Client other = live.connect();
    await_state(other, job, "running");
  }
  live.restart();
  client::Client client = live.connect();
  client.subscribe_all(number);
  EXPECT_EQ(next_of_all(client, number), job + " running");
  EXPECT_EQ(next_of_all(client, number), job + " queued") << "interrupted";
  client.call("job.cancel", {{"job", job}});
  for (std::string told; told != job + " cancelled";) told = next_of_all(client, number);
}

TEST(Streams, ASubscriptionToAllStandsBesideThoseToSingleJobs) {
  LiveServer live;
  client::Client client = live.connect();
  const std::string job = submit(client, "plain");
  ASSERT_EQ(final_state(client, job), "succeeded");
  client.subscribe_all();
  client.subscribe(job);
  int numbered = 0, plain = 0;
  for (int lives = 0; lives < 2;) {
    const Json event = *client.next_event();
    if (event.at("type") == "live") ++lives;
    if (event.at("type") == "state") ++(event.contains("number") ? numbered : plain);
  }
  EXPECT_EQ(numbered, 3);
  EXPECT_EQ(plain, 3);
  client.unsubscribe_all();
  submit(client, "plain");
  EXPECT_FALSE(client.next_event(0.0));
}

TEST(Streams, SubscribersToAllThatNeverReadHarmNobody) {
  LiveServer live([](Config& config) { config.stall = std::chrono::milliseconds(50); });
  client::Client honest = live.connect();
  std::vector<std::unique_ptr<client::Client>> silent;
  for (int i = 0; i < 20; ++i) {
    silent.push_back(std::make_unique<client::Client>(live.address(), "silent", client::Login{}, 0));
    silent.back()->subscribe_all();
  }
  for (int i = 0; i < 100; ++i) submit(honest, "plain");
  std::uint64_t number = 0;
  honest.subscribe_all();
  for (int ended = 0; ended < 100;) ended += next_of_all(honest, number).ends_with("succeeded") ? 1 : 0;
}

TEST(Streams, ADamagedEventComesWithoutItsData) {
  SCULPT_SQLITE_ONLY();
  LiveServer live;
  std::string job;
  {
    client::Client client = live.connect();
    job = submit(client, "plain");
    ASSERT_EQ(final_state(client, job), "succeeded");
  }
  live.stop();
  Database(live.data() / "sculptd.db").run("UPDATE event SET data='{' WHERE seq=2");
  live.restart();
  client::Client client = live.connect();
  client.subscribe(job, 1);
  EXPECT_TRUE(client.next_event()->at("more"));
  EXPECT_EQ(client.next_event()->at("data").at("to"), "succeeded");
}

// It gets what it asked for, and then it is gone.
TEST(Streams, APeerThatHasEndedItsSideIsToldToTheEnd) {
  LiveServer live;
  client::Client client = live.connect();
  const std::string job = submit(client, "hold");
  await_state(client, job, "running");
  client::Connection half(live.address());
  say_hello(half);
  half.send(R"({"id":1,"method":"events.subscribe","params":{"job":")" + job + "\"}}\n");
  half.end_sending();
  live.fake.gate.open();
  std::string line;
  while (line.find("succeeded") == std::string::npos) line = *half.read_line();
  EXPECT_THROW(while (true) half.read_line(), client::ServerUnreachable);
}

TEST(Streams, AClientThatAsksForMuchAndNeverReadsIsClosed) {
  LiveServer live([](Config& config) { config.stall = std::chrono::milliseconds(50); });
  client::Client honest = live.connect();
  const std::string job = submit(honest, "big");
  ASSERT_EQ(final_state(honest, job), "succeeded");
  client::Connection greedy(live.address());
  say_hello(greedy);
  const std::string request = R"({"id":1,"method":"artifact.read","params":{"job":")" + job +
                              R"(","artifact":"trajectory","offset":0,"bytes":4194304}})" + "\n";
  EXPECT_THROW(while (true) greedy.send(request), client::ServerUnreachable);
  std::ostringstream whole;
  honest.read_artifact({job, "trajectory"}, whole);
  EXPECT_EQ(whole.str().size(), fake_header.size() + (8u << 20) + fake_end.size());
}

TEST(Streams, AConnectionOverItsReplyLimitIsClosed) {
  LiveServer live([](Config& config) { config.reply_limit_bytes = 100'000; });
  client::Client honest = live.connect();
  const std::string job = submit(honest, "big");
  ASSERT_EQ(final_state(honest, job), "succeeded");
  std::ostringstream out;
  EXPECT_THROW(honest.read_artifact({job, "trajectory"}, out), client::ServerUnreachable);
  client::Client again = live.connect();
  again.read_artifact({job, "trajectory", {}, 0, 50'000}, out);
  EXPECT_EQ(out.str().size(), fake_header.size() + (8u << 20) + fake_end.size());
}

}  // namespace
}  // namespace sculpt::server
