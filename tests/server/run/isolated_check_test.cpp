#include "server/run/isolated_check.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "core/base/sha256.hpp"
#include "tests/server/live_server.hpp"

namespace sculpt::server {
namespace {

std::string refused(client::Client& client, const std::string& wish) {
  return refusal(client, "job.submit", {{"spec", make_spec(client, wish)}});
}

TEST(IsolatedCheck, AMeshThatCrashesItsReaderOrNeverLetsItEndIsRefusedAndTheServerLivesOn) {
  LiveServer server([](Config& config) { config.check_time = std::chrono::milliseconds(500); });
  client::Client client = server.connect();
  EXPECT_EQ(refused(client, "crashes its reader"), "mesh_unreadable");
  EXPECT_EQ(refused(client, "has no end"), "mesh_unreadable");
  EXPECT_EQ(final_state(client, submit(client, "plain")), "succeeded");
  EXPECT_TRUE(client.call("job.list").at("jobs").size() == 1);
}

TEST(IsolatedCheck, WhatTheCheckSaysIsWhatTheClientHears) {
  LiveServer server;
  client::Client client = server.connect();
  EXPECT_EQ(refused(client, "bad input"), "mesh_unreadable");
  try {
    client.call("job.submit", {{"spec", make_spec(client, "bad input")}});
  } catch (const client::ServerError& error) {
    EXPECT_STREQ(error.what(), "the file is no mesh");
  }
}

TEST(IsolatedCheck, OneWhoseReaderHasNoEndDoesNotKeepOthersWaiting) {
  LiveServer server;
  client::Client client = server.connect(), other = server.connect();
  std::jthread hung([&] { EXPECT_THROW(submit(other, "has no end"), std::runtime_error); });  // when the server stops
  EXPECT_EQ(final_state(client, submit(client, "plain")), "succeeded");
  EXPECT_EQ(final_state(client, submit(client, "big")), "succeeded");
  server.stop();
}

TEST(IsolatedCheck, WhatPassedOnceIsNotReadAgainAlsoByTheNextDaemon) {
  LiveServer server;
  {
    client::Client client = server.connect();
    submit(client, "plain");
  }
  server.restart([](Config& config) { config.worker = "/nowhere/sculptd"; });
  client::Client client = server.connect();
  EXPECT_EQ(final_state(client, submit(client, "plain")), "succeeded");
  EXPECT_EQ(refused(client, "new"), "internal_error") << "it is read in a process, and there can be none";
}

// A file that nobody could read into memory, and that takes no room on the disk.
std::string huge_blob(const LiveServer& server, const std::string& content) {
  const std::string sha256 = sha256_hex(content);
  const std::filesystem::path file = server.data() / "blobs" / sha256.substr(0, 2) / sha256;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << content;
  std::filesystem::resize_file(file, 1ull << 40);
  return sha256;
}

TEST(IsolatedCheck, AMeshIsRefusedByItsSizeBeforeItIsRead) {
  LiveServer server;
  client::Client client = server.connect();
  const Json mesh{{"blob", huge_blob(server, "mesh")}, {"name", "huge.stl"}};
  EXPECT_EQ(refusal(client, "job.submit", {{"spec", {{"mesh", mesh}, {"robot", "gantry"}, {"resolution", 8}}}}),
            "memory_cap");
}

TEST(IsolatedCheck, ACellBundleIsRefusedByItsSizeBeforeItIsRead) {
  LiveServer server;
  client::Client client = server.connect();
  Json spec = make_spec(client, "plain");
  spec["robot"] = {{"cell", {{"blob", huge_blob(server, "bundle")}}}};
  EXPECT_EQ(refusal(client, "job.submit", {{"spec", spec}}), "too_large");
}

}  // namespace
}  // namespace sculpt::server
