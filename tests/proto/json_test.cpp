#include "proto/json.hpp"

#include <gtest/gtest.h>

namespace sculpt::proto {
namespace {

std::string refusal(const std::string& text) {
  try {
    parse_json(text);
    return "accepted";
  } catch (const JsonError& error) {
    return error.what();
  }
}

std::string nested(int levels) {
  return std::string(static_cast<std::size_t>(levels), '[') + std::string(static_cast<std::size_t>(levels), ']');
}

TEST(Json, FieldsKeepTheirOrder) {
  EXPECT_EQ(write_json(parse_json(R"({"b":1,"a":[2,"x"]})")), R"({"b":1,"a":[2,"x"]})");
}

TEST(Json, DeepNestingIsRefusedBeforeParsing) {
  EXPECT_EQ(refusal(nested(max_json_depth)), "accepted");
  EXPECT_NE(refusal(nested(max_json_depth + 1)).find("64 levels"), std::string::npos);
  EXPECT_NE(refusal(std::string(1'000'000, '[')).find("64 levels"), std::string::npos);
  EXPECT_NE(refusal(std::string(200, '{')).find("64 levels"), std::string::npos);
}

TEST(Json, BracketsInStringsAreNoNesting) {
  EXPECT_EQ(refusal("\"" + std::string(1000, '[') + "\""), "accepted");
  EXPECT_EQ(refusal(R"(["\"[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[["])"), "accepted");
}

TEST(Json, HostileTextsAreRefusedWithASentence) {
  for (const char* text : {"",
                           "\xef\xbb\xbf{}",
                           " ",
                           "{",
                           "[1,]",
                           "{\"a\":}",
                           "nul",
                           "NaN",
                           "Infinity",
                           "1e400",
                           "-1e400",
                           "'a'",
                           "{a:1}",
                           "1 2",
                           "{}{}",
                           "\xef\xbb\xbf{",
                           "\"\xff\"",
                           "\"\xc0\x80\"",
                           "\"\\ud800\"",
                           "\"\\u0000\"",
                           "{\"\\u0000\":1}",
                           "{\"a\":1,\"a\":2}",
                           "[{\"a\":{\"b\":1,\"b\":1}}]",
                           "//c\n1"}) {
    const std::string why = refusal(text);
    EXPECT_NE(why, "accepted") << text;
    EXPECT_EQ(why.find("[json.exception"), std::string::npos) << why;
  }
}

TEST(Json, TheSameKeyInTwoObjectsIsNoDuplicate) {
  EXPECT_EQ(refusal(R"([{"a":1},{"a":2},{"a":{"a":3}}])"), "accepted");
}

TEST(Json, AnObjectWithVeryManyFieldsIsRefused) {
  std::string text = "{";
  for (int i = 0; i < 200'000; ++i) text += "\"" + std::to_string(i) + "\":1,";
  EXPECT_NE(refusal(text + "\"x\":1}").find("1000 fields"), std::string::npos);
}

TEST(Json, WritingNeverThrows) {
  EXPECT_EQ(write_json(Json("a\xff")), "\"a\xef\xbf\xbd\"");
}

TEST(Json, TextIsUtf8WithoutControlBytes) {
  for (const char* good :
       {"", "{\"a\":1}", "tab\there", "cr\r", "\xc3\xa9", "\xe2\x82\xac", "\xf0\x9f\x98\x80", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_TRUE(is_text(good)) << good;
  }
  for (const char* bad :
       {"\x01", "\x1b[0m", "\x7f", "\xff", "\xc0\x80", "\xc3", "\xe2\x82", "\xe0\x80\x80", "\xed\xa0\x80",
        "\xf0\x80\x80\x80", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\x80", "\x16\x03\x01"}) {
    EXPECT_FALSE(is_text(bad)) << bad;
  }
  EXPECT_FALSE(is_text(std::string_view("a\0b", 3)));
}

}  // namespace
}  // namespace sculpt::proto
