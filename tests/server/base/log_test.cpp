#include "server/base/log.hpp"

#include <gtest/gtest.h>

#include "proto/json.hpp"

namespace sculpt::server {
namespace {

std::string line(LogForm form, const std::string& message) {
  const spdlog::log_clock::time_point time{std::chrono::milliseconds(1769860800123)};
  spdlog::memory_buf_t out;
  LogFormatter(form).format({time, {}, "sculptd", spdlog::level::warn, message}, out);
  return {out.data(), out.size()};
}

TEST(Log, TextHasTimeLevelAndMessage) {
  EXPECT_EQ(line(LogForm::text, "job=01J attempt=2 running"),
            "2026-01-31T12:00:00.123Z warning job=01J attempt=2 running\n");
}

TEST(Log, JsonHasTheFieldsOfTheFirstWords) {
  EXPECT_EQ(proto::parse_json(line(LogForm::json, "job=01J attempt=2 conn=7 failed code=x: why")),
            Json({{"time", "2026-01-31T12:00:00.123Z"},
                  {"level", "warning"},
                  {"job", "01J"},
                  {"attempt", 2},
                  {"conn", 7},
                  {"message", "failed code=x: why"}}));
  EXPECT_EQ(proto::parse_json(line(LogForm::json, "conn=7"))["message"], "");
}

TEST(Log, StrangersCannotForgeFieldsOrLines) {
  const std::string hostile = "conn=7 client=x job=01J\nerror \xff";
  const Json json = proto::parse_json(line(LogForm::json, hostile));
  EXPECT_FALSE(json.contains("job"));
  EXPECT_EQ(json["conn"], 7);
  EXPECT_NE(line(LogForm::text, hostile).find("job=01J\\x0aerror"), std::string::npos);
}

// C1 control, next line, zero width, line separator, right-to-left override, isolate, byte order mark.
TEST(Log, WhatMovesTheCursorOrTurnsTheWritingIsShownAsItsNumber) {
  for (const auto& [tricky, shown] : std::vector<std::pair<std::string, std::string>>{{"\u0080", "\\u0080"},
                                                                                      {"\u009b", "\\u009b"},
                                                                                      {"\u200b", "\\u200b"},
                                                                                      {"\u2028", "\\u2028"},
                                                                                      {"\u202e", "\\u202e"},
                                                                                      {"\u2066", "\\u2066"},
                                                                                      {"\ufeff", "\\ufeff"},
                                                                                      {"\x7f", "\\u007f"}}) {
    const std::string message = "mesh=a" + tricky + "b";
    EXPECT_TRUE(line(LogForm::text, message).ends_with("mesh=a" + shown + "b\n")) << shown;
    const std::string json = line(LogForm::json, message);
    EXPECT_NE(json.find("a" + shown + "b"), std::string::npos) << json;
    EXPECT_EQ(proto::parse_json(json)["message"], message);
  }
  EXPECT_TRUE(line(LogForm::text, "\x9bK caf\xe9 \u00e9 \u5b57").ends_with("\\x9bK caf\\xe9 \u00e9 \u5b57\n"));
}

}  // namespace
}  // namespace sculpt::server
