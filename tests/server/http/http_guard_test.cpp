#include "server/http/http_guard.hpp"

#include <gtest/gtest.h>

namespace sculpt::server {
namespace {

TEST(HttpGuard, ThisMachineAndTheNamedHostsMayBeCalled) {
  const std::vector<std::string> names{"Planner.example", "192.0.2.7"};
  for (const char* host : {"localhost", "LOCALHOST:7878", "127.0.0.1:7878", "127.1.2.3", "[::1]:7878",
                           "planner.example:80", "192.0.2.7", "localhost:"}) {
    EXPECT_TRUE(host_allowed(host, names)) << host;
  }
}

TEST(HttpGuard, AnyOtherNameIsRefused) {
  for (const char* host : {"", ":7878", "evil.example", "127.0.0.1.evil.example", "localhost.evil.example", "192.0.2.8",
                           "[::2]", "[::1", "0.0.0.0", "localhost:x@evil", "localhost:7878@evil", "127.0.0.1:78 78",
                           "localhost:123456", "[::1]evil", "[::1]:x", "localhost@evil"}) {
    EXPECT_FALSE(host_allowed(host, {"planner.example"})) << host;
  }
}

TEST(HttpGuard, OnlyPagesOfTheSameOriginOrANamedOneMayCall) {
  const std::vector<std::string> origins{"https://dash.example"};
  EXPECT_TRUE(origin_allowed("", "localhost:7878", origins));
  EXPECT_TRUE(origin_allowed("http://localhost:7878", "localhost:7878", origins));
  EXPECT_TRUE(origin_allowed("https://dash.example", "localhost:7878", origins));
  for (const char* origin : {"null", "http://localhost", "http://localhost:3000", "https://evil.example",
                             "https://dash.example.evil", "localhost:7878"}) {
    EXPECT_FALSE(origin_allowed(origin, "localhost:7878", origins)) << origin;
  }
}

}  // namespace
}  // namespace sculpt::server
