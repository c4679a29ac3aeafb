#include "server/run/isolated_examination.hpp"

#include <gtest/gtest.h>

#include "tests/server/live_server.hpp"

namespace sculpt::server {
namespace {

/// A bundle of a cell without files, as `robot` names it.
Json send_cell(client::Client& client, const std::string& name) {
  const Json bundle{{"name", name}, {"cell", "{}"}, {"files", Json::object()}};
  return {{"cell", {{"blob", client.upload(proto::write_json(bundle))}}}};
}

TEST(IsolatedExamination, ACellOfTheServerAndOneThatWasSentAreExamined) {
  LiveServer server;
  client::Client client = server.connect();
  EXPECT_EQ(client.call("cell.check", {{"robot", "gantry"}}), Json({{"cell", "gantry"}, {"resolution", 64}}));
  const Json sent = client.call("cell.check", {{"robot", send_cell(client, "mine")}, {"resolution", 16}});
  EXPECT_EQ(sent, Json({{"cell", "mine"}, {"resolution", 16}}));
}

TEST(IsolatedExamination, ACellThatEndsTheProcessOrNeverLetsItEndIsRefusedAndTheServerLivesOn) {
  LiveServer server([](Config& config) { config.check_time = std::chrono::milliseconds(500); });
  client::Client client = server.connect();
  EXPECT_EQ(refusal(client, "cell.check", {{"robot", send_cell(client, "crashes its reader")}}), "cell_invalid");
  EXPECT_EQ(refusal(client, "cell.check", {{"robot", send_cell(client, "has no end")}}), "cell_invalid");
  EXPECT_EQ(client.call("cell.check", {{"robot", "gantry"}}).at("cell"), "gantry");
}

TEST(IsolatedExamination, WhatCannotBeLookedAtIsRefusedWithItsPlace) {
  LiveServer server;
  client::Client client = server.connect();
  EXPECT_EQ(refusal(client, "cell.check", {{"robot", "nosuch"}}), "cell_unknown");
  EXPECT_EQ(refusal(client, "cell.check", {{"robot", "../gantry"}}), "params_invalid");
  EXPECT_EQ(refusal(client, "cell.check", {{"robot", "gantry"}, {"resolution", 7}}), "params_invalid");
  EXPECT_EQ(refusal(client, "cell.check", {{"robot", "gantry"}, {"resolution", 24}}), "resolution_invalid");
  EXPECT_EQ(refusal(client, "cell.check", Json::object()), "params_invalid");
  const Json missing{{"cell", {{"blob", std::string(64, '0')}}}};
  EXPECT_EQ(refusal(client, "cell.check", {{"robot", missing}}), "blob_missing");
}

}  // namespace
}  // namespace sculpt::server
