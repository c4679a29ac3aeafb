// HTTP as a client sees it that does what no client should; the rest is tests/clients/http_test.py.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "tests/server/live_server.hpp"

namespace sculpt::server {
namespace {

// One request on a connection of its own: the whole reply, or its beginning if it is not read to its end.
std::string ask(const LiveServer& live, const std::string& request) {
  client::Connection connection(live.address());
  connection.send(request);
  std::string reply;
  try {
    while (const std::optional<std::string> line = connection.read_line()) reply += *line + "\n";
  } catch (const client::ServerUnreachable&) {
  }
  return reply;
}

std::string get(const std::string& path, const std::string& fields = "Connection: close\r\n") {
  return "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n" + fields + "\r\n";
}

TEST(Http, RequestsMayBeSentAllAtOnce) {
  LiveServer live;
  const std::string reply = ask(live, get("/livez", "") + get("/readyz", "") + get("/nothing"));
  const std::size_t alive = reply.find("alive"), ready = reply.find("ready\n"), missing = reply.find("404 Not Found");
  EXPECT_LT(alive, ready) << reply;
  EXPECT_LT(ready, missing) << reply;
  EXPECT_NE(missing, std::string::npos) << reply;
}

TEST(Http, ADownloadThatIsNotReadIsEnded) {
  LiveServer live([](Config& config) { config.stall = std::chrono::milliseconds(50); });
  client::Client client = live.connect();
  const std::string job = submit(client, "big");
  ASSERT_EQ(final_state(client, job), "succeeded");
  client::Connection sleeper(live.address());
  sleeper.send(get("/v1/artifacts/" + job + "/trajectory"));
  // The client, this question's own connection, and until it is ended the sleeper.
  while (ask(live, get("/metrics")).find("\nsculptd_connections 2\n") == std::string::npos) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(client.call("ping"), Json::object());
}

TEST(Http, ARequestThatNeverEndsIsEnded) {
  LiveServer live([](Config& config) { config.hello_time = std::chrono::milliseconds(50); });
  EXPECT_EQ(ask(live, "GET /livez HTTP/1.1\r\nHost:"), "");
}

}  // namespace
}  // namespace sculpt::server
