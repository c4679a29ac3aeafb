// What became of a stored file since it was stored: it is never given out as the artifact.
#include "server/results/artifacts.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/server/live_server.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

struct Damage {
  const char* name;
  void (*to)(const fs::path& file);
};

void flip(const fs::path& file) {
  std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
  bytes.seekp(-2, std::ios::end);
  bytes << '?';
}

void link_away(const fs::path& file) {
  const fs::path elsewhere = file.parent_path().parent_path().parent_path() / "elsewhere";
  fs::rename(file, elsewhere);
  fs::create_symlink(elsewhere, file);
}

class ArtifactDamage : public testing::TestWithParam<Damage> {
 protected:
  std::string finished(const std::string& wish) {
    const std::string job = submit(client, wish);
    EXPECT_EQ(final_state(client, job), "succeeded");
    return job;
  }
  fs::path file(const std::string& job, const std::string& name) const { return live.results(job) / name; }
  // The word of the error that the whole is refused with, read in pieces.
  std::string read_all(const std::string& job, const std::string& artifact, const std::string& format = {}) {
    std::ostringstream out;
    try {
      client.read_artifact({job, artifact, format, 0, 64 << 10}, out);
      return out.str();
    } catch (const client::ServerError& error) {
      return error.code();
    }
  }
  std::string http(const std::string& path) {
    client::Connection connection(live.address());
    connection.send("GET /v1/artifacts/" + path + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
    std::string reply;
    try {
      while (const std::optional<std::string> line = connection.read_line()) reply += *line + "\n";
    } catch (const client::ServerUnreachable&) {
    }
    return reply;
  }
  void expect_retry_makes_it_whole(const std::string& job, const std::string& artifact, const std::string& before) {
    const Json shown = client.call("job.get", {{"job", job}});
    EXPECT_EQ(shown.at("state"), "succeeded");
    EXPECT_EQ(shown.at("error").at("code"), "artifact_damaged");
    EXPECT_NE(shown.at("error").at("message").get<std::string>().find("sculpt retry " + job), std::string::npos);
    EXPECT_EQ(client.call("job.retry", {{"job", job}}).at("state"), "queued");
    EXPECT_EQ(final_state(client, job), "succeeded");
    EXPECT_EQ(read_all(job, artifact), before);
    EXPECT_FALSE(client.call("job.get", {{"job", job}}).contains("error"));
    EXPECT_EQ(refusal(client, "job.retry", {{"job", job}}), "wrong_state");
  }

  LiveServer live;
  client::Client client = live.connect();
};

TEST_P(ArtifactDamage, OfABigTrajectoryIsSeenAtTheLatestAtItsLastPiece) {
  const std::string job = finished("big");
  const std::string before = read_all(job, "trajectory");
  ASSERT_GT(before.size(), 8u << 20);
  GetParam().to(file(job, "trajectory.ndjson"));
  EXPECT_EQ(read_all(job, "trajectory"), "artifact_damaged");
  EXPECT_EQ(refusal(client, "job.verify", {{"job", job}}), "artifact_damaged");
  EXPECT_EQ(read_all(job, "trajectory", "csv"), "artifact_damaged") << "nothing is made of it";
  const std::string reply = http(job + "/trajectory");
  EXPECT_LT(reply.size(), before.size()) << "the last bytes do not go out";
  expect_retry_makes_it_whole(job, "trajectory", before);
}

TEST_P(ArtifactDamage, OfASmallArtifactIsSeenBeforeTheFirstByte) {
  const std::string job = finished("plain");
  const std::string before = read_all(job, "report");
  GetParam().to(file(job, "report.json"));
  EXPECT_EQ(refusal(client, "job.report", {{"job", job}}), "artifact_damaged");
  EXPECT_EQ(read_all(job, "report"), "artifact_damaged");
  const std::string reply = http(job + "/report");
  EXPECT_EQ(reply.find("HTTP/1.1 500"), 0u) << reply;
  EXPECT_EQ(reply.find("ETag"), std::string::npos) << reply;
  EXPECT_NE(reply.find("artifact_damaged"), std::string::npos) << reply;
  EXPECT_NE(http(job + "/voxels").find("200 OK"), std::string::npos) << "the others are as good as before";
  expect_retry_makes_it_whole(job, "report", before);
}

TEST_P(ArtifactDamage, OfAnExportIsHealedByMakingItAgain) {
  const std::string job = finished("plain");
  const std::string before = read_all(job, "trajectory", "csv");
  ASSERT_EQ(before, "csv\n" + fake_header + fake_end);
  GetParam().to(file(job, "trajectory.csv"));
  const std::string first = read_all(job, "trajectory", "csv");
  EXPECT_TRUE(first == before || first == "artifact_damaged") << first;
  EXPECT_EQ(read_all(job, "trajectory", "csv"), before);
  EXPECT_FALSE(client.call("job.get", {{"job", job}}).contains("error"));
}

INSTANTIATE_TEST_SUITE_P(Kinds, ArtifactDamage,
                         testing::Values(Damage{"cut", [](const fs::path& file) { fs::resize_file(file, 5); }},
                                         Damage{"emptied", [](const fs::path& file) { fs::resize_file(file, 0); }},
                                         Damage{"flipped", flip},
                                         Damage{"deleted", [](const fs::path& file) { fs::remove(file); }},
                                         Damage{"linked", link_away}),
                         [](const auto& damage) { return std::string(damage.param.name); });

TEST(Artifacts, AFolderThatIsALinkIsNotFollowed) {
  LiveServer live;
  client::Client client = live.connect();
  const std::string job = submit(client, "plain");
  ASSERT_EQ(final_state(client, job), "succeeded");
  const fs::path folder = live.data() / "jobs" / job;
  fs::rename(folder, live.data() / "elsewhere");
  fs::create_directory_symlink(live.data() / "elsewhere", folder);
  EXPECT_EQ(refusal(client, "job.report", {{"job", job}}), "artifact_damaged");
  EXPECT_EQ(client.call("job.retry", {{"job", job}}).at("state"), "queued");
  EXPECT_EQ(final_state(client, job), "succeeded");
  EXPECT_FALSE(fs::is_symlink(folder));
  EXPECT_EQ(client.call("job.report", {{"job", job}}).at("state"), "succeeded");
}

TEST(Artifacts, WhatIsMadeOfATrajectoryIsListedWithItsHash) {
  LiveServer live;
  client::Client client = live.connect();
  const std::string job = submit(client, "plain");
  ASSERT_EQ(final_state(client, job), "succeeded");
  const auto listed = [&] { return client.call("artifact.list", {{"job", job}}).at("artifacts").at(0); };
  EXPECT_FALSE(listed().contains("made"));
  std::ostringstream csv;
  client.read_artifact({job, "trajectory", "csv"}, csv);
  EXPECT_EQ(listed().at("made"),
            (Json{{{"format", "csv"}, {"size", csv.str().size()}, {"sha256", sha256_hex(csv.str())}}}));
}

// A reader that begins in the middle has to look himself; one that is misled by it must not be told of damage.
TEST(Artifacts, PiecesInAnyOrderAreServed) {
  LiveServer live;
  client::Client client = live.connect();
  const std::string job = submit(client, "plain");
  ASSERT_EQ(final_state(client, job), "succeeded");
  client::Connection connection(live.address());
  say_hello(connection);
  for (const int offset : {3, 0, 10, 0, 5, 10, 0, 20}) {
    const Json params{{"job", job}, {"artifact", "trajectory"}, {"offset", offset}, {"bytes", offset == 0 ? 5 : 100}};
    connection.send(proto::write_json({{"id", 1}, {"method", "artifact.read"}, {"params", params}}) + "\n");
    const Json result = proto::parse_json(*connection.read_line()).at("result");
    EXPECT_EQ(result.at("eof"), offset != 0);
    connection.read_chunk(result.at("bytes"));
  }
  EXPECT_FALSE(client.call("job.get", {{"job", job}}).contains("error"));
}

}  // namespace
}  // namespace sculpt::server
