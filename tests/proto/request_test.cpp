#include "proto/request.hpp"

#include <gtest/gtest.h>

namespace sculpt::proto {
namespace {

std::string error_of(const std::string& line) {
  const ParsedLine parsed = parse_request(line);
  return parsed.error ? parsed.error->code() + " " + parsed.error->pointer() : "fine";
}

TEST(Request, ALineBecomesARequest) {
  const ParsedLine parsed = parse_request(R"({"jsonrpc":"2.0","id":"a","method":"job.get","params":{"job":"x"}})");
  ASSERT_FALSE(parsed.error);
  EXPECT_EQ(parsed.request.id, "a");
  EXPECT_EQ(parsed.request.method, "job.get");
  EXPECT_EQ(parsed.request.params, Json({{"job", "x"}}));
}

TEST(Request, VersionAndParamsMayBeLeftOut) {
  const ParsedLine parsed = parse_request(R"({"id":1,"method":"ping"})");
  ASSERT_FALSE(parsed.error);
  EXPECT_EQ(parsed.request.params, Json::object());
}

TEST(Request, WhatIsNoRequestIsSaidSo) {
  EXPECT_EQ(error_of("{"), "parse_error ");
  EXPECT_EQ(error_of("[]"), "bad_request ");
  EXPECT_EQ(error_of("3"), "bad_request ");
  EXPECT_EQ(error_of(R"({"method":"ping"})"), "bad_request ");
  EXPECT_EQ(error_of(R"({"id":null,"method":"ping"})"), "bad_request /id");
  EXPECT_EQ(error_of(R"({"id":1.5,"method":"ping"})"), "bad_request /id");
  EXPECT_EQ(error_of(R"({"id":")" + std::string(129, 'x') + R"(","method":"ping"})"), "bad_request /id");
  EXPECT_EQ(error_of(R"({"id":1})"), "bad_request /method");
  EXPECT_EQ(error_of(R"({"id":1,"method":7})"), "bad_request /method");
  EXPECT_EQ(error_of(R"({"id":1,"method":"ping","params":[]})"), "bad_request /params");
  EXPECT_EQ(error_of(R"({"id":1,"method":"ping","jsonrpc":"1.0"})"), "bad_request /jsonrpc");
  EXPECT_EQ(error_of(R"({"id":1,"method":"ping","param":{}})"), "bad_request ");
}

TEST(Request, TheIdIsKeptForTheErrorWhereItCouldBeRead) {
  EXPECT_EQ(parse_request(R"({"id":9,"method":"ping","params":7})").request.id, 9);
  EXPECT_TRUE(parse_request(R"({"id":9,)").request.id.is_null());
}

std::string chunk_of(const std::string& line) {
  try {
    const auto bytes = announced_chunk(parse_request(line).request);
    return bytes ? std::to_string(*bytes) : "none";
  } catch (const ProtocolError& error) {
    return error.code();
  }
}

TEST(Request, OnlyBlobPutAnnouncesAChunkAndUnusableCountsAreRefused) {
  EXPECT_EQ(chunk_of(R"({"id":1,"method":"blob.put","params":{"bytes":12}})"), "12");
  EXPECT_EQ(chunk_of(R"({"id":1,"method":"blob.put","params":{"bytes":4194304}})"), "4194304");
  EXPECT_EQ(chunk_of(R"({"id":1,"method":"artifact.read","params":{"bytes":12}})"), "none");
  // Known to be wrong for other reasons, but the chunk behind it must still be skipped.
  EXPECT_EQ(chunk_of(R"({"id":1,"method":"blob.put","x":1,"params":{"bytes":12}})"), "12");
  for (const char* bytes :
       {"-1", "4194305", "9223372036854775808", "18446744073709551616", "1.0", "\"12\"", "null", "[]"}) {
    EXPECT_EQ(chunk_of(std::string(R"({"id":1,"method":"blob.put","params":{"bytes":)") + bytes + "}}"), "bad_request")
        << bytes;
  }
  EXPECT_EQ(chunk_of(R"({"id":1,"method":"blob.put"})"), "bad_request");
  EXPECT_EQ(chunk_of(R"({"id":1,"method":"blob.put","params":[]})"), "bad_request");
}

}  // namespace
}  // namespace sculpt::proto
