#include "server/http/byte_range.hpp"

#include <gtest/gtest.h>

#include <tuple>

namespace sculpt::server {
namespace {

using Kind = ByteRange::Kind;

TEST(ByteRange, TheThreeFormsGiveTheirBytes) {
  const auto part = [](const char* header) {
    const ByteRange range = read_range(header, 10);
    return std::tuple(range.kind, range.offset, range.bytes);
  };
  EXPECT_EQ(part("bytes=0-0"), std::tuple(Kind::part, 0u, 1u));
  EXPECT_EQ(part("bytes=2-4"), std::tuple(Kind::part, 2u, 3u));
  EXPECT_EQ(part("bytes=9-"), std::tuple(Kind::part, 9u, 1u));
  EXPECT_EQ(part("bytes=-3"), std::tuple(Kind::part, 7u, 3u));
  EXPECT_EQ(part("bytes=-30"), std::tuple(Kind::part, 0u, 10u));
  EXPECT_EQ(part("bytes=4-18446744073709551615"), std::tuple(Kind::part, 4u, 6u));
}

TEST(ByteRange, WhatIsNotThereCannotBeHad) {
  for (const char* header : {"bytes=10-", "bytes=10-12", "bytes=-0"}) {
    EXPECT_EQ(read_range(header, 10).kind, Kind::unsatisfiable) << header;
  }
  for (const char* header : {"bytes=0-", "bytes=-1"}) {
    EXPECT_EQ(read_range(header, 0).kind, Kind::unsatisfiable) << header;
  }
}

TEST(ByteRange, WhatIsNoRangeIsLeftAlone) {
  for (const char* header : {"", "bytes", "bytes=", "bytes=-", "bytes=a-b", "bytes=4-2", "bytes=1-2,4-5", "items=0-1",
                             "bytes=-1-2", "bytes=+1-2", "bytes=1 - 2", "bytes=99999999999999999999-"}) {
    EXPECT_EQ(read_range(header, 10).kind, Kind::whole) << header;
  }
}

}  // namespace
}  // namespace sculpt::server
