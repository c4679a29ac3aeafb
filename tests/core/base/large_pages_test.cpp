#include "core/base/large_pages.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

namespace sculpt {
namespace {

TEST(LargePages, HoldWhatIsWrittenAtEverySize) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{1000}, (std::size_t{1} << 20) - 1,
                                  std::size_t{1} << 20, (std::size_t{1} << 20) + 1, std::size_t{3} << 20}) {
    Words words(count), other = words;
    std::iota(words.begin(), words.end(), count);
    std::iota(other.begin(), other.end(), 2 * count);
    for (std::size_t at = 0; at < count; ++at) {
      ASSERT_EQ(words[at], count + at);
      ASSERT_EQ(other[at], 2 * count + at);
    }
    words.push_back(7);
    EXPECT_EQ(words.back(), 7u);
  }
}

TEST(LargePages, LargeBlocksBeginOnAPageOfTwoMebibytes) {
  const Words words(std::size_t{4} << 20);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(words.data()) % (2 << 20), 0u);
}

TEST(LargePages, MemoryThatThereIsNotIsRefused) {
  LargePages<std::uint64_t> pages;
  EXPECT_THROW(static_cast<void>(pages.allocate(std::numeric_limits<std::size_t>::max() / 64)), std::bad_alloc);
}

}  // namespace
}  // namespace sculpt
