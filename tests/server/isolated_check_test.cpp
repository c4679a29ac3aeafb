#include "server/isolated_check.hpp"

#include <gtest/gtest.h>

#include "tests/server/live_server.hpp"

namespace sculpt {
namespace {

std::string refused(Client& client, const std::string& wish) {
  return refusal(client, "job.submit", {{"spec", make_spec(client, wish)}});
}

TEST(IsolatedCheck, AMeshThatCrashesItsReaderOrNeverLetsItEndIsRefusedAndTheServerLivesOn) {
  LiveServer server([](Config& config) { config.check_time = std::chrono::milliseconds(500); });
  Client client = server.connect();
  EXPECT_EQ(refused(client, "crashes its reader"), "mesh_unreadable");
  EXPECT_EQ(refused(client, "has no end"), "mesh_unreadable");
  EXPECT_EQ(final_state(client, submit(client, "plain")), "succeeded");
  EXPECT_TRUE(client.call("job.list").at("jobs").size() == 1);
}

TEST(IsolatedCheck, WhatTheCheckSaysIsWhatTheClientHears) {
  LiveServer server;
  Client client = server.connect();
  EXPECT_EQ(refused(client, "bad input"), "mesh_unreadable");
  try {
    client.call("job.submit", {{"spec", make_spec(client, "bad input")}});
  } catch (const ServerError& error) {
    EXPECT_STREQ(error.what(), "the file is no mesh");
  }
}

TEST(IsolatedCheck, OneWhoseReaderHasNoEndDoesNotKeepOthersWaiting) {
  LiveServer server;
  Client client = server.connect(), other = server.connect();
  submit(client, "plain");
  std::jthread hung([&] { EXPECT_THROW(submit(other, "has no end"), std::runtime_error); });  // when the server stops
  EXPECT_EQ(final_state(client, submit(client, "plain")), "succeeded");
  server.stop();
}

TEST(KnownFiles, AreThoseOfMeshStockAndUploadedCell) {
  KnownFiles known;
  JobSpec spec;
  spec.mesh = {"a", "a.stl"};
  EXPECT_FALSE(known.has(spec));
  known.add(spec);
  spec.resolution = 512;
  EXPECT_TRUE(known.has(spec));
  for (const auto& change : std::vector<std::function<void(JobSpec&)>>{
           [](JobSpec& other) { other.mesh.sha256 = "b"; }, [](JobSpec& other) { other.mesh.name = "a.ply"; },
           [](JobSpec& other) { other.stock_mesh = other.mesh; }, [](JobSpec& other) { other.cell_bundle = "c"; }}) {
    JobSpec other = spec;
    change(other);
    EXPECT_FALSE(known.has(other));
  }
}

}  // namespace
}  // namespace sculpt
