// What milled plans leave, as files: made by a process of its own when first asked for, and kept.
#include "server/results/machined_files.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "core/base/sha256.hpp"
#include "tests/server/live_server.hpp"

namespace sculpt::server {
namespace {

class MachinedFilesTest : public testing::Test {
 protected:
  std::string finished(const std::string& wish, bool with_tools) {
    Json spec = make_spec(client, wish);
    if (with_tools) spec["mill"] = {{"tools", {"D20"}}, {"library", {{"tools", Json::array()}}}};
    const std::string job = client.call("job.submit", {{"spec", spec}}).at("job");
    EXPECT_EQ(final_state(client, job), "succeeded");
    return job;
  }
  // The whole of it, or the word of the error.
  std::string fetch(const std::string& job, const std::string& artifact, const std::string& format) {
    std::ostringstream out;
    try {
      client.read_artifact({job, artifact, format}, out);
      return out.str();
    } catch (const client::ServerError& error) {
      return error.code();
    }
  }
  Json listed(const std::string& job, const std::string& artifact) {
    const Json reply = client.call("artifact.list", {{"job", job}});
    for (const Json& entry : reply.at("artifacts"))
      if (entry.at("artifact") == artifact) return entry;
    return {};
  }

  LiveServer live;
  client::Client client = live.connect();
};

TEST_F(MachinedFilesTest, AreMadeOnceAndListedWithTheirHash) {
  const std::string job = finished("bust", true);
  EXPECT_EQ(listed(job, "surface"),
            (Json{{"artifact", "surface"}, {"formats", {"ply"}}, {"size", 0}, {"final", false}}));
  for (const auto& [artifact, format, text] :
       {std::array{"surface", "ply", "surface of bust"}, std::array{"stock", "zip", "stocks of bust"}}) {
    EXPECT_EQ(fetch(job, artifact, format), text);
    EXPECT_EQ(listed(job, artifact).at("made"),
              (Json{{{"format", format}, {"size", std::string(text).size()}, {"sha256", sha256_hex(text)}}}));
    const std::filesystem::path file = live.results(job) / (std::string(artifact) + "." + format);
    const auto long_ago = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1);
    std::filesystem::last_write_time(file, long_ago);
    EXPECT_EQ(fetch(job, artifact, format), text);
    EXPECT_EQ(std::filesystem::last_write_time(file), long_ago) << "it is not made again";
  }
  EXPECT_EQ(fetch(job, "surface", ""), "surface of bust") << "its only form";
  EXPECT_EQ(fetch(job, "stock", ""), "left of bust 1") << "that of the end";
}

TEST_F(MachinedFilesTest, WithoutToolsThereIsNone) {
  const std::string job = finished("bust", false);
  EXPECT_EQ(fetch(job, "surface", "ply"), "wrong_state");
  EXPECT_EQ(fetch(job, "stock", "zip"), "wrong_state");
  EXPECT_EQ(fetch(job, "surface", "zip"), "params_invalid");
}

TEST_F(MachinedFilesTest, WhatCannotBeMadeSaysWhyAndLeavesNothing) {
  const std::string job = finished("surface refused", true);
  EXPECT_EQ(fetch(job, "surface", "ply"), "mesh_unreadable");
  for (const auto& entry : std::filesystem::directory_iterator(live.results(job)))
    EXPECT_EQ(entry.path().filename().string().find("surface"), std::string::npos) << entry.path();
}

}  // namespace
}  // namespace sculpt::server
