// Lines that no client should send: the sender gets a clear error, everybody else notices nothing.
#include <gtest/gtest.h>

#include <sstream>

#include "core/base/random.hpp"
#include "tests/server/live_server.hpp"

namespace sculpt::server {
namespace {

bool closed(client::Connection& connection) {
  try {
    connection.read_line();
    return false;
  } catch (const client::ServerUnreachable&) {
    return true;
  }
}

class BadLines : public testing::Test {
 protected:
  ~BadLines() override {
    client::Client client = live.connect();
    EXPECT_EQ(client.call("ping"), Json::object()) << "the daemon is unharmed";
    EXPECT_TRUE(client.call("job.list").at("jobs").empty());
  }
  LiveServer live;
};

TEST_F(BadLines, AMalformedLineGetsAnErrorAndTheConnectionLivesOn) {
  client::Connection connection(live.address());
  say_hello(connection);
  const std::string deep(70, '[');
  const std::vector<std::pair<std::string, std::string>> lines{
      {"{", "parse_error"},
      {"hello", "parse_error"},
      {"[]", "bad_request"},
      {"\"text\"", "bad_request"},
      {deep, "parse_error"},
      {R"({"id":1,"id":2,"method":"ping"})", "parse_error"},
      {R"({"id":1,"method":"ping","params":{"x":1e999}})", "parse_error"},
      {R"({"id":1,"method":"ping","params":{"x":"\u0000"}})", "parse_error"},
      {R"({"id":1,"method":"ping","params":{"x":1}})", "params_invalid"},
      {R"({"id":1,"method":"ping","x":1})", "bad_request"},
      {R"({"method":"ping"})", "bad_request"},
      {R"({"id":1,"method":"nothing"})", "unknown_method"},
      {R"({"id":1,"method":"job.get"})", "params_invalid"},
      {R"({"id":1,"method":"job.get","params":{"job":7}})", "params_invalid"},
      {R"({"id":1,"method":"job.get","params":{"job":"x"}})", "not_found"},
      {R"({"id":1,"method":"job.submit","params":{"spec":{"resolution":"8"}}})", "params_invalid"},
      {R"({"id":1,"method":"events.subscribe","params":{"job":"x"}})", "not_found"},
      {R"({"id":1,"method":"artifact.read","params":{"job":"x","artifact":"report","offset":0,"bytes":1}})",
       "not_found"},
      {R"({"id":1,"method":"artifact.read","params":{"job":"x","artifact":"report","offset":0,"bytes":4194305}})",
       "params_invalid"},
  };
  for (const auto& [line, code] : lines) {
    connection.send(line + "\n");
    EXPECT_EQ(read_error(connection), code) << line;
  }
}

TEST_F(BadLines, AnOverlongLineGetsAnErrorAndTheEnd) {
  client::Connection connection(live.address());
  say_hello(connection);
  connection.send("{\"id\":1,\"method\":\"" + std::string(proto::max_line_bytes, 'x') + "\"}\n");
  EXPECT_EQ(read_error(connection), "line_too_long");
  EXPECT_TRUE(closed(connection));
}

TEST_F(BadLines, BinaryGarbageGetsAnErrorAndTheEnd) {
  for (const std::string& garbage :
       {std::string("\x16\x03\x01\x02\x00\x01", 6), std::string("{\"id\":\x01}"), std::string("{\"\xff\xfe\"}")}) {
    client::Connection connection(live.address());
    say_hello(connection);
    connection.send(garbage + "\n");
    EXPECT_EQ(read_error(connection), "not_text");
    EXPECT_TRUE(closed(connection));
  }
}

TEST_F(BadLines, AnotherProtocolIsTurnedAwayAtItsFirstLine) {
  client::Connection connection(live.address());
  connection.send("EHLO x\r\n{\"id\":1,\"method\":\"ping\"}\n");
  EXPECT_EQ(read_error(connection), "not_text");
  EXPECT_TRUE(closed(connection));
}

TEST_F(BadLines, HelloComesFirstAndWithTheRightVersion) {
  client::Connection connection(live.address());
  connection.send("{\"id\":1,\"method\":\"ping\"}\n");
  EXPECT_EQ(read_error(connection), "hello_required");
  connection.send(
      "{\"id\":1,\"method\":\"hello\",\"params\":{\"protocol\":[2,0],\"client\":\"x\"}}\n{\"id\":2,\"method\":\"ping\"}"
      "\n");
  EXPECT_EQ(read_error(connection), "protocol_unsupported");
  EXPECT_TRUE(closed(connection));
}

TEST_F(BadLines, AChunkOfUnknownLengthEndsTheConnection) {
  for (const char* bytes : {"-1", "9223372036854775808", "4194305", "\"1\"", "null"}) {
    client::Connection connection(live.address());
    say_hello(connection);
    connection.send(std::string(R"({"id":1,"method":"blob.put","params":{"bytes":)") + bytes + "}}\n");
    EXPECT_EQ(read_error(connection), "bad_request") << bytes;
    EXPECT_TRUE(closed(connection));
  }
}

TEST_F(BadLines, TheChunkOfARefusedUploadIsSkipped) {
  client::Connection connection(live.address());
  say_hello(connection);
  connection.send(
      "{\"id\":1,\"method\":\"blob.put\",\"params\":{\"sha256\":\"x\",\"size\":4,\"offset\":0,\"bytes\":4}}\n{\n}\n\n{"
      "\"id\":2,\"method\":\"ping\"}\n");
  EXPECT_EQ(read_error(connection), "params_invalid");
  EXPECT_EQ(read_error(connection), R"({"jsonrpc":"2.0","id":2,"result":{}})");
}

TEST_F(BadLines, AClientThatVanishesMidStreamHarmsNobody) {
  for (const char* last :
       {"{\"id\":1,\"meth",
        "{\"id\":1,\"method\":\"blob.put\",\"params\":{\"sha256\":\"x\",\"size\":9,\"offset\":0,\"bytes\":9}}\nabc"}) {
    client::Connection connection(live.address());
    say_hello(connection);
    connection.send(last);
  }
}

TEST_F(BadLines, WhatWasAskedBeforeTheClientEndedItsSideIsAnswered) {
  client::Connection connection(live.address());
  connection.send(
      "{\"id\":1,\"method\":\"hello\",\"params\":{\"protocol\":[1,0],\"client\":\"x\"}}\n"
      "{\"id\":2,\"method\":\"blob.has\",\"params\":{\"sha256\":\"" +
      std::string(64, 'a') +
      "\"}}\n"
      "{\"id\":3,\"method\":\"ping\"}\n");
  connection.end_sending();
  for (int id = 1; id <= 3; ++id) EXPECT_EQ(proto::parse_json(*connection.read_line()).at("id"), id);
  EXPECT_TRUE(closed(connection));
}

TEST_F(BadLines, ErrorsKeepToTheClientsLineLimit) {
  client::Connection connection(live.address());
  connection.send(R"({"id":1,"method":"hello","params":{"protocol":[1,0],"client":"plc","max_line":256}})"
                  "\n");
  connection.read_line();
  for (const std::string& id : {std::string("x"), std::string(128, 'x')}) {
    connection.send("{\"id\":\"" + id + "\",\"method\":\"nothing\"}\n");
    const std::string line = *connection.read_line();
    EXPECT_LE(line.size(), 256u);
    EXPECT_EQ(proto::parse_json(line).at("error").at("data").at("code"), "unknown_method");
  }
}

TEST_F(BadLines, RandomBytesNeverHarmTheDaemon) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::string bytes =
        seed % 2 == 0 ? "" : "{\"id\":0,\"method\":\"hello\",\"params\":{\"protocol\":[1,0],\"client\":\"x\"}}\n";
    const std::string letters = "{}[]\":,\n\r019.e-truefalsn \\u\xff";
    for (std::uint64_t i = random.next() % 3000; i > 0; --i) {
      bytes += seed % 3 == 0 ? static_cast<char>(random.next()) : letters[random.next() % letters.size()];
    }
    client::Connection connection(live.address());
    try {
      connection.send(bytes);
      connection.end_sending();
      while (connection.read_line()) continue;
    } catch (const client::ServerUnreachable&) {
      continue;
    }
  }
}

}  // namespace
}  // namespace sculpt::server
