// The whole server as clients see it.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <sstream>
#include <thread>

#include "tests/server/live_server.hpp"

namespace sculpt::server {
namespace {

TEST(Live, AJobIsUploadedSubmittedPlannedAndFetched) {
  LiveServer live;
  client::Client client = live.connect();
  const std::string job = submit(client, "plain");
  EXPECT_EQ(final_state(client, job), "succeeded");
  std::ostringstream trajectory;
  EXPECT_EQ(client.read_artifact({job, "trajectory"}, trajectory), (fake_header + fake_end).size());
  EXPECT_EQ(trajectory.str(), fake_header + fake_end);
  const Json report = client.call("job.report", {{"job", job}});
  EXPECT_EQ(report.at("job"), job);
  EXPECT_EQ(report.at("state"), "succeeded");
  EXPECT_EQ(report.at("robot"), "gantry");
  EXPECT_TRUE(client.call("job.verify", {{"job", job}}).at("clean"));
}

TEST(Live, TwoClientsAtOnceOneWatchesTheOtherListsCancelsAndFetches) {
  LiveServer live;
  client::Client watcher = live.connect();
  client::Client other = live.connect();
  const std::string held = submit(watcher, "hold"), plain = submit(watcher, "plain");
  watcher.subscribe(held);

  EXPECT_EQ(final_state(other, plain), "succeeded");
  const Json list = other.call("job.list");
  ASSERT_EQ(list.at("jobs").size(), 2u);
  EXPECT_EQ(list.at("jobs")[0].at("job"), held);
  EXPECT_EQ(list.at("jobs")[1].at("state"), "succeeded");
  std::ostringstream voxels;
  other.read_artifact({plain, "voxels"}, voxels);
  EXPECT_EQ(voxels.str(), "#binvox 1\n");
  await_state(other, held, "running");
  EXPECT_EQ(other.call("job.cancel", {{"job", held}}).at("state"), "cancelling");

  std::vector<std::string> states;
  std::vector<std::uint64_t> seqs;
  while (states.empty() || states.back() != "cancelled") {
    const Json event = *watcher.next_event();
    if (event.at("type") != "state") continue;
    states.push_back(event.at("data").at("to"));
    seqs.push_back(event.at("seq"));
  }
  EXPECT_EQ(states, (std::vector<std::string>{"queued", "running", "cancelling", "cancelled"}));
  EXPECT_EQ(seqs, (std::vector<std::uint64_t>{1, 2, 3, 4}));
}

TEST(Live, ATrajectoryIsReadWhileItGrows) {
  LiveServer live;
  client::Client client = live.connect();
  const std::string job = submit(client, "hold");
  std::ostringstream out;
  // Until it has caught up with what is there, and that is something.
  const std::uint64_t offset = client.read_artifact({job, "trajectory"}, out, [&] { return out.str().empty(); });
  EXPECT_EQ(out.str(), fake_header);
  const Json listed = client.call("artifact.list", {{"job", job}});
  EXPECT_FALSE(listed.at("artifacts")[0].at("final"));
  EXPECT_EQ(listed.at("artifacts")[0].at("size"), fake_header.size());
  live.fake.gate.open();
  client.read_artifact({job, "trajectory", {}, offset}, out);
  EXPECT_EQ(out.str(), fake_header + fake_end);
}

TEST(Live, CsvAndBinaryAreMadeFromTheFinalTrajectory) {
  LiveServer live;
  client::Client client = live.connect();
  const std::string held = submit(client, "hold");
  await_state(client, held, "running");
  EXPECT_EQ(refusal(client, "artifact.read",
                    {{"job", held}, {"artifact", "trajectory"}, {"format", "csv"}, {"offset", 0}, {"bytes", 1}}),
            "wrong_state");
  live.fake.gate.open();
  ASSERT_EQ(final_state(client, held), "succeeded");
  for (int again = 0; again < 2; ++again) {
    std::ostringstream csv, binary;
    client.read_artifact({held, "trajectory", "csv"}, csv);
    client.read_artifact({held, "trajectory", "binary"}, binary);
    EXPECT_EQ(csv.str(), "csv\n" + fake_header + fake_end);
    EXPECT_EQ(binary.str(), "sct\n" + fake_header + fake_end);
  }
}

TEST(Live, ReadingInSmallPiecesFromAnywhereGivesTheSameBytes) {
  LiveServer live;
  client::Client client = live.connect();
  const std::string job = submit(client, "plain");
  ASSERT_EQ(final_state(client, job), "succeeded");
  const std::string whole = fake_header + fake_end;
  for (std::uint64_t from = 0; from <= whole.size(); ++from) {
    std::ostringstream out;
    client.read_artifact({job, "trajectory", "ndjson", from, 5}, out);
    EXPECT_EQ(out.str(), whole.substr(from));
  }
  EXPECT_EQ(refusal(client, "artifact.read",
                    {{"job", job}, {"artifact", "trajectory"}, {"offset", whole.size() + 1}, {"bytes", 1}}),
            "params_invalid");
}

TEST(Live, WhatTheCheckFindsIsRefusedAndNothingIsQueued) {
  LiveServer live;
  client::Client client = live.connect();
  EXPECT_EQ(refusal(client, "job.submit", {{"spec", make_spec(client, "bad input")}}), "mesh_unreadable");
  Json unknown_cell = make_spec(client, "plain");
  unknown_cell["robot"] = "nobody";
  EXPECT_EQ(refusal(client, "job.submit", {{"spec", unknown_cell}}), "cell_unknown");
  Json nameless = make_spec(client, "plain");
  nameless["mesh"]["name"] = "mesh";
  EXPECT_EQ(refusal(client, "job.submit", {{"spec", nameless}}), "params_invalid");
  EXPECT_TRUE(client.call("job.list").at("jobs").empty());
}

TEST(Live, AFailedJobSaysWhyAndHasNoArtifacts) {
  LiveServer live;
  client::Client client = live.connect();
  const std::string job = submit(client, "fails");
  EXPECT_EQ(final_state(client, job), "failed");
  EXPECT_EQ(client.call("job.get", {{"job", job}}).at("error").at("code"), "no_transit");
  EXPECT_EQ(refusal(client, "job.report", {{"job", job}}), "wrong_state");
  EXPECT_EQ(refusal(client, "job.verify", {{"job", job}}), "wrong_state");
  EXPECT_EQ(refusal(client, "job.cancel", {{"job", job}}), "wrong_state");
  EXPECT_EQ(refusal(client, "artifact.read", {{"job", job}, {"artifact", "trajectory"}, {"offset", 0}, {"bytes", 1}}),
            "wrong_state");
  // A failed job leaves no files: they go once all who wait for its end were told.
  while (std::filesystem::exists(live.data() / "jobs" / job)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(Live, AnUncleanPlanIsAFailureThatCanBeLookedAt) {
  LiveServer live;
  client::Client client = live.connect();
  const std::string job = submit(client, "unclean");
  EXPECT_EQ(final_state(client, job), "failed");
  EXPECT_EQ(client.call("job.get", {{"job", job}}).at("error").at("code"), "verify_failed");
  EXPECT_EQ(client.call("job.report", {{"job", job}}).at("state"), "failed");
  const Json verdict = client.call("job.verify", {{"job", job}});
  EXPECT_FALSE(verdict.at("clean"));
  EXPECT_EQ(verdict.at("findings")[0].at("line"), 2);
  EXPECT_EQ(verdict.at("exempt_pairs"), proto::parse_json(R"([{"links": ["base", "arm"], "why": "a bearing"}])"));
}

TEST(Live, ARepeatedSubmitGivesTheSameJob) {
  LiveServer live;
  client::Client client = live.connect();
  const Json params{{"key", "order"}, {"spec", make_spec(client, "plain")}};
  const Json first = client.call("job.submit", params);
  live.restart();
  client::Client later = live.connect();
  const Json second = later.call("job.submit", params);
  EXPECT_EQ(second.at("job"), first.at("job"));
  EXPECT_TRUE(second.at("duplicate"));
  Json other = params;
  other["spec"]["resolution"] = 16;
  EXPECT_EQ(refusal(later, "job.submit", other), "key_conflict");
}

TEST(Live, AStopPutsRunningJobsBackAndTheNextDaemonFinishesThem) {
  LiveServer live;
  std::string running, waiting, done;
  {
    client::Client client = live.connect();
    done = submit(client, "plain");
    ASSERT_EQ(final_state(client, done), "succeeded");
    running = submit(client, "hold");
    await_state(client, running, "running");
    waiting = submit(client, "hold");
  }
  live.restart();
  client::Client client = live.connect();
  EXPECT_EQ(client.call("job.get", {{"job", done}}).at("state"), "succeeded");
  live.fake.gate.open();
  EXPECT_EQ(final_state(client, running), "succeeded");
  EXPECT_EQ(final_state(client, waiting), "succeeded");
  client.subscribe(running);
  std::vector<std::string> reasons;
  while (reasons.empty() || reasons.back() != "finished") {
    const Json event = *client.next_event();
    if (event.at("type") == "state") reasons.push_back(event.at("data").at("reason"));
  }
  EXPECT_EQ(reasons, (std::vector<std::string>{"submitted", "claimed", "interrupted", "claimed", "finished"}));
}

TEST(Live, ACellBundleOfTheClientIsUsed) {
  LiveServer live;
  client::Client client = live.connect();
  const Json bundle{
      {"name", "mine"}, {"cell", "{}"}, {"files", {{"room.urdf", {{"blob", client.upload("<robot/>")}}}}}};
  Json spec = make_spec(client, "plain");
  spec["robot"] = {{"cell", {{"blob", client.upload(proto::write_json(bundle))}}}};
  const std::string job = client.call("job.submit", {{"spec", spec}}).at("job");
  ASSERT_EQ(final_state(client, job), "succeeded");
  EXPECT_EQ(client.call("job.report", {{"job", job}}).at("robot"), "mine");
  const Json broken{{"name", "mine"}, {"cell", "{}"}, {"files", {{"room.urdf", {{"blob", std::string(64, '0')}}}}}};
  spec["robot"] = {{"cell", {{"blob", client.upload(proto::write_json(broken))}}}};
  EXPECT_EQ(refusal(client, "job.submit", {{"spec", spec}}), "blob_missing");
}

TEST(Live, WaitAnswersAtItsTimeLimitToo) {
  LiveServer live;
  client::Client client = live.connect();
  const std::string job = submit(client, "hold");
  await_state(client, job, "running");
  const Json reply = client.call("job.wait", {{"job", job}, {"timeout_s", 0}});
  EXPECT_EQ(reply.at("state"), "running");
  EXPECT_TRUE(reply.at("timed_out"));
}

TEST(Live, AClientWithShortLinesGetsListsInShortPages) {
  LiveServer live;
  client::Client client = live.connect();
  std::vector<std::string> jobs;
  for (int i = 0; i < 5; ++i) jobs.push_back(submit(client, "plain"));
  for (const std::string& job : jobs) final_state(client, job);
  client::Connection plc(live.address());
  plc.send(R"({"id":1,"method":"hello","params":{"protocol":[1,0],"client":"plc","max_line":512}})"
           "\n");
  plc.read_line();
  plc.send("{\"id\":2,\"method\":\"job.list\"}\n");
  const std::string line = *plc.read_line();
  EXPECT_LE(line.size(), 512u);
  const Json page = proto::parse_json(line).at("result");
  EXPECT_EQ(page.at("jobs")[0].at("job"), jobs.front());
  EXPECT_TRUE(page.at("more"));
  plc.send("{\"id\":3,\"method\":\"artifact.list\",\"params\":{\"job\":\"" + jobs.front() + "\"}}\n");
  EXPECT_EQ(read_error(plc), "reply_too_long");
}

TEST(Live, ASecondDaemonOnTheSameFolderOrPortIsRefused) {
  LiveServer live;
  Config config;
  config.port = 0;
  config.data = live.data();
  FakePlanner fake;
  EXPECT_ANY_THROW(Server(config, fake.planner()));
  const TempFolder other;
  config.data = other.path();
  config.port = static_cast<std::uint16_t>(std::stoi(live.address().substr(live.address().rfind(':') + 1)));
  EXPECT_ANY_THROW(Server(config, fake.planner()));
  client::Client client = live.connect();
  EXPECT_EQ(client.call("ping"), Json::object());
}

}  // namespace
}  // namespace sculpt::server
