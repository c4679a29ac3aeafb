// Events and readers that do not keep up.
#include <gtest/gtest.h>

#include <sstream>

#include "tests/server/live_server.hpp"

namespace sculpt {
namespace {

TEST(Streams, ProgressComesWhileAJobRunsAndCarriesNoSeq) {
  LiveServer live;
  Client client = live.connect();
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
  Client client = live.connect();
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
  Client client = live.connect();
  const std::string job = submit(client, "hold");
  client.subscribe(job);
  client.unsubscribe(job);
  client.call("job.cancel", {{"job", job}});
  EXPECT_EQ(final_state(client, job), "cancelled");
  EXPECT_FALSE(client.next_event(0.0));
}

TEST(Streams, TwentySubscribersThatNeverReadHarmNobody) {
  LiveServer live;
  Client honest = live.connect();
  std::vector<std::string> jobs;
  for (int i = 0; i < 10; ++i) jobs.push_back(submit(honest, "hold"));
  std::vector<std::unique_ptr<Client>> silent;
  for (int i = 0; i < 20; ++i) {
    silent.push_back(std::make_unique<Client>(live.address(), "silent"));
    for (const std::string& job : jobs) silent.back()->subscribe(job);
  }
  live.fake.gate.open();
  for (const std::string& job : jobs) EXPECT_EQ(final_state(honest, job), "succeeded");
  silent.resize(10);  // half of them vanish
  EXPECT_EQ(final_state(honest, submit(honest, "plain")), "succeeded");
}

TEST(Streams, AClientThatAsksForMuchAndNeverReadsIsClosed) {
  LiveServer live([](Config& config) { config.stall = std::chrono::milliseconds(50); });
  Client honest = live.connect();
  const std::string job = submit(honest, "big");
  ASSERT_EQ(final_state(honest, job), "succeeded");
  Connection greedy(live.address());
  say_hello(greedy);
  const std::string request = R"({"id":1,"method":"artifact.read","params":{"job":")" + job +
                              R"(","artifact":"trajectory","offset":0,"bytes":4194304}})" + "\n";
  EXPECT_THROW(while (true) greedy.send(request), ServerUnreachable);
  std::ostringstream whole;
  honest.read_artifact({job, "trajectory"}, whole);
  EXPECT_EQ(whole.str().size(), fake_header.size() + (8u << 20) + fake_end.size());
}

TEST(Streams, AConnectionOverItsReplyLimitIsClosed) {
  LiveServer live([](Config& config) { config.reply_limit_bytes = 100'000; });
  Client honest = live.connect();
  const std::string job = submit(honest, "big");
  ASSERT_EQ(final_state(honest, job), "succeeded");
  std::ostringstream out;
  EXPECT_THROW(honest.read_artifact({job, "trajectory"}, out), ServerUnreachable);
  Client again = live.connect();
  again.read_artifact({job, "trajectory", {}, 0, 50'000}, out);
  EXPECT_EQ(out.str().size(), fake_header.size() + (8u << 20) + fake_end.size());
}

}  // namespace
}  // namespace sculpt
