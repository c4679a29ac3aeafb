// Programs of finished jobs: made once, kept with the job, and what becomes of one that cannot be made.
#include "server/results/programs.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/base/sha256.hpp"
#include "tests/server/live_server.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

class ProgramsTest : public testing::Test {
 protected:
  explicit ProgramsTest(std::chrono::milliseconds limit = std::chrono::minutes(10))
      : live([limit](Config& config) { config.result_time = limit; }) {}
  static Json spec(const std::string& name, double feed_m_s = 0.05) {
    return {{"dialect", "krl"}, {"name", name}, {"motion", {{"feed_m_s", feed_m_s}}}};
  }
  std::string finished(const std::string& wish = "plain") {
    const std::string job = submit(client, wish);
    final_state(client, job);
    return job;
  }
  // The whole of it, or the word of the error.
  std::string fetch(const std::string& job, const Json& program) {
    std::ostringstream out;
    try {
      client::ArtifactRequest request{job, "program"};
      request.program = program;
      client.read_artifact(request, out);
      return out.str();
    } catch (const client::ServerError& error) {
      return error.code();
    }
  }
  Json made(const std::string& job) {
    const Json listed = client.call("artifact.list", {{"job", job}}).at("artifacts").back();
    EXPECT_EQ(listed.at("artifact"), "program");
    return listed.value("made", Json::array());
  }
  std::vector<fs::path> files(const std::string& job, const char* kind) const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(live.results(job)))
      if (entry.path().extension() == kind) found.push_back(entry.path());
    return found;
  }

  LiveServer live;
  client::Client client = live.connect();
};

TEST_F(ProgramsTest, OneIsMadeOnceAndListedWithItsHash) {
  const std::string job = finished();
  EXPECT_EQ(made(job), Json::array());
  const std::string first = fetch(job, spec("bust"));
  EXPECT_EQ(first, "krl bust 0.05 of plain");
  const std::vector<fs::path> zips = files(job, ".zip");
  ASSERT_EQ(zips.size(), 1u);
  const fs::file_time_type long_ago = fs::file_time_type::clock::now() - std::chrono::hours(1);
  fs::last_write_time(zips[0], long_ago);
  EXPECT_EQ(fetch(job, spec("bust")), first);
  EXPECT_EQ(fs::last_write_time(zips[0]), long_ago) << "it is not made again";
  EXPECT_EQ(
      made(job),
      (Json{{{"format", "zip"}, {"size", first.size()}, {"sha256", sha256_hex(first)}, {"program", spec("bust")}}}));
}

TEST_F(ProgramsTest, ADownloadGoesOnWhereItBroke) {
  const std::string job = finished(), whole = fetch(job, spec("bust"));
  std::ostringstream rest;
  client::ArtifactRequest request{job, "program", "", 4};
  request.program = spec("bust");
  client.read_artifact(request, rest);
  EXPECT_EQ(rest.str(), whole.substr(4));
}

TEST_F(ProgramsTest, AnotherSpecIsAnotherProgramAndTheOldestGo) {
  const std::string job = finished();
  for (int feed = 1; feed <= 12; ++feed) {
    EXPECT_EQ(fetch(job, spec("bust", feed)), "krl bust " + std::to_string(feed) + " of plain");
    for (const fs::path& file : files(job, ".zip"))
      fs::last_write_time(file, fs::last_write_time(file) - std::chrono::seconds(10));
  }
  EXPECT_EQ(made(job).size(), 8u);
  EXPECT_EQ(files(job, ".zip").size(), 8u);
  EXPECT_EQ(files(job, ".program").size(), 8u);
  for (const Json& one : made(job)) EXPECT_GT(one.at("program").at("motion").at("feed_m_s"), 4);
  EXPECT_EQ(fetch(job, spec("bust", 1)), "krl bust 1 of plain") << "it can be made again";
}

TEST_F(ProgramsTest, WhatStopsTheProcessIsSaidAndLeavesNothing) {
  const std::string job = finished();
  EXPECT_EQ(fetch(job, spec("refused")), "axes_unfit");
  EXPECT_EQ(fetch(job, spec("crashes")), "internal_error");
  EXPECT_EQ(fetch(job, spec("writes_none")), "storage_error");
  EXPECT_EQ(made(job), Json::array());
  for (const auto& entry : fs::directory_iterator(live.results(job)))
    EXPECT_EQ(entry.path().filename().string().find("program-"), std::string::npos) << entry.path();
  EXPECT_EQ(fetch(job, spec("bust")), "krl bust 0.05 of plain");
}

struct ImpatientProgramsTest : ProgramsTest {
  ImpatientProgramsTest() : ProgramsTest(std::chrono::milliseconds(200)) {}
};

TEST_F(ImpatientProgramsTest, WhatTakesTooLongIsStoppedAndLeavesNothing) {
  const std::string job = finished();
  EXPECT_EQ(fetch(job, spec("endless")), "run_time_exceeded");
  EXPECT_EQ(made(job), Json::array());
}

TEST_F(ProgramsTest, NothingIsMadeOfAPlanThatMustNotBeRunOrIsNotThere) {
  EXPECT_EQ(fetch(finished("unclean"), spec("bust")), "wrong_state");
  EXPECT_EQ(fetch(finished("fails"), spec("bust")), "wrong_state");
  const std::string held = submit(client, "hold");
  EXPECT_EQ(fetch(held, spec("bust")), "wrong_state");
  live.fake.gate.open();
  EXPECT_EQ(final_state(client, held), "succeeded");
  EXPECT_EQ(fetch(held, spec("bust")), "krl bust 0.05 of hold");
}

TEST_F(ProgramsTest, WhatIsNoSpecIsRefusedBeforeAnythingIsDone) {
  const std::string job = finished();
  EXPECT_EQ(fetch(job, nullptr), "params_invalid");
  EXPECT_EQ(fetch(job, {{"dialect", "apt"}}), "dialect_unknown");
  EXPECT_EQ(fetch(job, spec("../bust")), "name_invalid");
  EXPECT_EQ(refusal(client, "artifact.link", {{"job", job}, {"artifact", "program"}, {"program", spec("No")}}),
            "name_invalid");
  EXPECT_EQ(refusal(client, "artifact.read",
                    {{"job", job}, {"artifact", "report"}, {"program", spec("bust")}, {"offset", 0}, {"bytes", 1}}),
            "params_invalid");
}

TEST_F(ProgramsTest, ADamagedOneIsMadeAgain) {
  const std::string job = finished(), good = fetch(job, spec("bust"));
  std::ofstream(files(job, ".zip").at(0), std::ios::in) << "X";
  EXPECT_EQ(fetch(job, spec("bust")), "artifact_damaged");
  EXPECT_EQ(fetch(job, spec("bust")), good);
  EXPECT_FALSE(client.call("job.get", {{"job", job}}).contains("error"));
}

TEST_F(ProgramsTest, ALinkIsForOneProgram) {
  const std::string job = finished(), good = fetch(job, spec("bust"));
  const std::string path =
      client.call("artifact.link", {{"job", job}, {"artifact", "program"}, {"program", spec("bust")}}).at("path");
  EXPECT_TRUE(path.ends_with("/bust.zip")) << path;
  client::Connection connection(live.address());
  connection.send("GET " + path + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  std::string reply;
  try {
    while (const std::optional<std::string> line = connection.read_line()) reply += *line + "\n";
  } catch (const client::ServerUnreachable&) {
  }
  EXPECT_NE(reply.find("application/zip"), std::string::npos) << reply;
  EXPECT_NE(reply.find(sha256_hex(good)), std::string::npos) << reply;
}

}  // namespace
}  // namespace sculpt::server
