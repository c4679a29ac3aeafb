#include "proto/error_codes.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "proto/crc32.hpp"

namespace sculpt::proto {
namespace {

TEST(ErrorCodes, EveryErrorHasItsRowInTheProtocol) {
  std::ifstream in(std::string(SOURCE_DIR) + "/proto/PROTOCOL.md");
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  for (const ErrorCode& code : error_catalogue()) {
    const std::string row = "| " + std::to_string(code.number) + " | `" + std::string(code.word) + "` | " +
                            (code.retryable ? "yes" : "no") + " |";
    EXPECT_NE(text.find(row), std::string::npos) << row;
  }
}

TEST(ErrorCodes, WordsAndNumbersAreGivenOnce) {
  std::set<std::string_view> words;
  std::set<int> numbers;
  for (const ErrorCode& code : error_catalogue()) {
    EXPECT_TRUE(words.insert(code.word).second) << code.word;
    EXPECT_TRUE(numbers.insert(code.number).second) << code.number;
  }
}

TEST(ErrorCodes, AWordThatIsNotKnownIsAPlanners) {
  EXPECT_EQ(find_error("something_new").number, 5100);
  EXPECT_EQ(error_object("not_found", "gone", "/params/job"),
            Json({{"code", 2001},
                  {"message", "gone"},
                  {"data", {{"code", "not_found"}, {"retryable", false}, {"pointer", "/params/job"}}}}));
}

TEST(Crc32, AgreesWithTheStandardsCheckValue) {
  EXPECT_EQ(crc32_hex("123456789"), "cbf43926");
  EXPECT_EQ(crc32_hex(""), "00000000");
}

}  // namespace
}  // namespace sculpt::proto
