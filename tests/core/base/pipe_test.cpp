#include "core/base/pipe.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sculpt {
namespace {

TEST(Pipe, AllIsTakenUpInOrder) {
  for (const bool beside : {false, true})
    for (const int count : {0, 1, 255, 256, 100'000}) {
      SCOPED_TRACE(count);
      std::vector<int> taken;
      Pipe<int> pipe([&](int item) { taken.push_back(item); }, beside);
      for (int item = 0; item < count; ++item) pipe.put(item);
      pipe.finish();
      ASSERT_EQ(taken.size(), static_cast<std::size_t>(count));
      for (int item = 0; item < count; ++item) ASSERT_EQ(taken[static_cast<std::size_t>(item)], item);
    }
}

TEST(Pipe, NothingIsTakenUpAfterWhatThrew) {
  for (const bool beside : {false, true}) {
    int last = -1;
    Pipe<int> pipe(
        [&](int item) {
          if (item == 1000) throw std::runtime_error("no further");
          last = item;
        },
        beside);
    const auto put_all = [&] {
      for (int item = 0; item < 100'000; ++item) pipe.put(item);
      pipe.finish();
    };
    EXPECT_THROW(put_all(), std::runtime_error);
    EXPECT_EQ(last, 999);
  }
}

TEST(Pipe, WhatIsNotFinishedIsDropped) {
  int taken = 0;
  {
    Pipe<int> pipe([&](int) { ++taken; }, true);
    for (int item = 0; item < 10; ++item) pipe.put(item);
  }
  EXPECT_EQ(taken, 0);
}

}  // namespace
}  // namespace sculpt
