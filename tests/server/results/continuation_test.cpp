// A job that takes what another left as its stock, as far as the server is concerned.
#include "server/results/continuation.hpp"

#include <gtest/gtest.h>

#include "tests/server/live_server.hpp"

namespace sculpt::server {
namespace {

using Client = client::Client;

std::string finished(Client& client, const Json& spec) {
  const std::string job = client.call("job.submit", {{"spec", spec}}).at("job");
  EXPECT_EQ(final_state(client, job), "succeeded");
  return job;
}

Json continuing(Client& client, const std::string& job) {
  Json spec = make_spec(client, "continued");
  spec["continue"] = {{"job", job}, {"rotation_rad", {1.0, 0.0, 0.0}}};
  return spec;
}

/// What the planner was given beside the mesh.
Json seen(Client& client, const std::string& job) {
  return client.call("job.report", {{"job", job}}).at("seen");
}

std::string refused(Client& client, const std::string& job) {
  return refusal(client, "job.submit", {{"spec", continuing(client, job)}});
}

class Continuation : public testing::Test {
 protected:
  LiveServer live;
  Client client = live.connect();
};

TEST_F(Continuation, StandsWhereTheOtherDidInWhatItLeft) {
  Json spec = make_spec(client, "plain");
  spec["placement"] = {{"margin_m", 0.01}};
  spec["stock"] = {{"box", {{"min_m", {0, 0, 0}}, {"max_m", {0.1, 0.1, 0.1}}}}};
  const std::string first = finished(client, spec), second = finished(client, continuing(client, first)),
                    third = finished(client, continuing(client, second));
  EXPECT_EQ(seen(client, first), (Json{{"margin_m", 0.01}, {"box", true}, {"clampings", Json::array()}}));
  EXPECT_EQ(seen(client, second), (Json{{"margin_m", 0.01}, {"box", true}, {"clampings", {"left of plain 1"}}}));
  EXPECT_EQ(seen(client, third),
            (Json{{"margin_m", 0.01}, {"box", true}, {"clampings", {"left of plain 1", "left of continued 1"}}}));
  EXPECT_EQ(client.call("job.get", {{"job", third}}).at("continues"), second);
  EXPECT_FALSE(client.call("job.get", {{"job", first}}).contains("continues"));
}

TEST_F(Continuation, DoesNotNeedTheOtherAnyMore) {
  const std::string first = finished(client, make_spec(client, "plain"));
  const Json params{{"key", "second"}, {"spec", continuing(client, first)}};
  client.call("queue.pause", Json::object());
  const std::string second = client.call("job.submit", params).at("job");
  live.restart([](Config& config) { config.keep = std::chrono::seconds(0); });
  Client meanwhile = live.connect();
  while (refusal(meanwhile, "job.get", {{"job", first}}) == "accepted") std::this_thread::yield();
  EXPECT_EQ(refused(meanwhile, first), "gone");
  EXPECT_EQ(meanwhile.call("job.submit", params).at("job"), second) << "a repeated submit is the same job all the same";
  live.restart([](Config& config) { config.keep = std::chrono::hours(1); });
  Client later = live.connect();
  later.call("queue.resume", Json::object());
  EXPECT_EQ(final_state(later, second), "succeeded");
  EXPECT_EQ(seen(later, second).at("clampings"), Json::array({"left of plain 1"}));
}

TEST_F(Continuation, OfAJobThatHasNotSucceededIsRefused) {
  EXPECT_EQ(refused(client, "01M7XRMDB8NWM1BF9DPP1KFA0R"), "not_found");
  const std::string held = submit(client, "hold"), failed = submit(client, "fails"),
                    unclean = submit(client, "unclean");
  EXPECT_EQ(refused(client, held), "wrong_state");
  EXPECT_EQ(final_state(client, failed), "failed");
  EXPECT_EQ(refused(client, failed), "wrong_state");
  EXPECT_EQ(final_state(client, unclean), "failed");
  EXPECT_EQ(refused(client, unclean), "wrong_state") << "it has left something, that must not be run";
  live.fake.gate.open();
  EXPECT_EQ(final_state(client, held), "succeeded");
  EXPECT_EQ(refused(client, held), "accepted");
}

TEST_F(Continuation, OfADamagedStockIsRefused) {
  const std::string first = finished(client, make_spec(client, "plain"));
  std::filesystem::resize_file(live.results(first) / "stock.binvox", 3);
  EXPECT_EQ(refused(client, first), "artifact_damaged");
}

}  // namespace
}  // namespace sculpt::server
