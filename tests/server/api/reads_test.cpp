// Who asks waits for nobody's change.
#include <gtest/gtest.h>

#include <atomic>
#include <sstream>
#include <thread>

#include "server/store/sqlite/sqlite.hpp"
#include "tests/server/live_server.hpp"
#include "tests/server/test_store.hpp"

namespace sculpt::server {
namespace {

constexpr int max_tries = 20;

// Everything that a client of scope read may ask, of a job that has ended.
void ask_all(client::Client& client, const std::string& job) {
  for (const char* method : {"ping", "server.info", "server.schema", "job.list", "events.unsubscribe"})
    client.call(method);
  for (const char* method : {"job.get", "job.report", "artifact.list"}) client.call(method, {{"job", job}});
  client.call("job.wait", {{"job", job}, {"timeout_s", 0}});
  client.subscribe(job);
  EXPECT_EQ(client.next_event()->at("seq"), 1);
  client.subscribe_all();
  std::ostringstream bytes;
  client.read_artifact({job, "trajectory"}, bytes);
}

// The test takes the database's lock for writing, so that a cancel waits for it as for a slow disk. SQLite gives up
// after 5 s: where the machine is so busy that all the questions take longer, it is tried again.
TEST(Reads, AreAnsweredWhileAChangeIsBeingWritten) {
  SCULPT_SQLITE_ONLY();
  LiveServer live;
  client::Client client = live.connect();
  const std::string done = submit(client, "plain"), held = submit(client, "hold");
  ASSERT_EQ(final_state(client, done), "succeeded");
  await_state(client, held, "running");
  bool first = false;
  for (int attempt = 0; attempt < max_tries && !first; ++attempt) {
    Database other(live.data() / "sculptd.db");
    other.run("BEGIN IMMEDIATE");
    std::atomic<bool> changed = false;
    std::jthread changer([&] {
      client::Client slow = live.connect();
      refusal(slow, "job.pause", {{"job", held}});
      changed = true;
    });
    client::Client asking = live.connect();
    ask_all(asking, done);
    first = !changed;
    other.run("ROLLBACK");
  }
  EXPECT_TRUE(first);
}

TEST(Reads, OfOneConnectionComeInOrderAndSeeItsChanges) {
  LiveServer live;
  client::Client client = live.connect();
  const std::string job = submit(client, "hold");
  client::Connection connection(live.address());
  say_hello(connection);
  const std::string params = R"(,"params":{"job":")" + job + "\"}}\n";
  connection.send(R"({"id":1,"method":"job.get")" + params + R"({"id":2,"method":"job.cancel")" + params +
                  R"({"id":3,"method":"job.get")" + params + R"({"id":4,"method":"ping"})" + "\n");
  std::vector<std::string> states;
  for (int id = 1; id <= 4; ++id) {
    const Json reply = proto::parse_json(*connection.read_line());
    EXPECT_EQ(reply.at("id"), id);
    states.push_back(reply.at("result").value("state", ""));
  }
  EXPECT_TRUE(states[2] == "cancelling" || states[2] == "cancelled") << states[2];
}

// The answer to a wait may come at any time: it must not let the request behind a held back one go first.
TEST(Reads, AWaitThatEndsBreaksNoOrder) {
  LiveServer live;
  client::Client client = live.connect();
  const std::string job = submit(client, "plain");
  ASSERT_EQ(final_state(client, job), "succeeded");
  client::Connection connection(live.address());
  say_hello(connection);
  std::string all;
  for (int id = 1; id <= 200; ++id) {
    all += R"({"id":"wait","method":"job.wait","params":{"timeout_s":0,"job":")" + job + "\"}}\n";
    all +=
        R"({"id":)" + std::to_string(id) + (id % 2 == 0 ? R"(,"method":"ping"})" : R"(,"method":"job.list"})") + "\n";
  }
  connection.send(all);
  int last = 0;
  for (int reply = 0; reply < 400; ++reply) {
    const Json id = proto::parse_json(*connection.read_line()).at("id");
    if (id == "wait") continue;
    EXPECT_EQ(id, last + 1);
    last = id;
  }
}

TEST(Reads, AWaitForAJobThatIsNotThereIsRefused) {
  LiveServer live;
  client::Client client = live.connect();
  EXPECT_EQ(refusal(client, "job.wait", {{"job", "nobody"}, {"timeout_s", 86400}}), "not_found");
  const std::string job = submit(client, "hold");
  const Json end = client.call("job.wait", {{"job", job}, {"timeout_s", 0.01}});
  EXPECT_TRUE(end.at("timed_out"));
}

}  // namespace
}  // namespace sculpt::server
