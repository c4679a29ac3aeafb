#include "core/base/helpers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace sculpt {
namespace {

TEST(Helpers, EveryIndexIsVisitedOnceAtAnyNumberOfThreads) {
  for (int threads : {0, 1, 2, 5}) {
    for (std::size_t count : {0u, 1u, 3u, 1000u}) {
      std::vector<int> visits(count);
      Helpers(threads).for_each_index(count, [&](std::size_t i) { ++visits[i]; });
      EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), static_cast<std::ptrdiff_t>(count));
    }
  }
}

TEST(Helpers, TheFirstExceptionByIndexComesThroughAndTheRestIsDone) {
  for (int threads : {1, 3}) {
    std::atomic<int> done{0};
    std::string said;
    try {
      Helpers(threads).for_each_index(100, [&](std::size_t i) {
        ++done;
        if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
      });
    } catch (const std::runtime_error& error) {
      said = error.what();
    }
    EXPECT_EQ(said, "7");
    EXPECT_EQ(done, 100);
  }
}

TEST(Helpers, TakePartInLoopsWithinLoops) {
  for (int threads : {1, 2, 4}) {
    const Helpers helpers(threads);
    for (int round = 0; round < 50; ++round) {
      std::atomic<int> visits{0};
      helpers.for_each_index(3, [&](std::size_t) {
        helpers.for_each_index(20, [&](std::size_t) { helpers.for_each_index(2, [&](std::size_t) { ++visits; }); });
      });
      ASSERT_EQ(visits, 3 * 20 * 2) << threads << " threads, round " << round;
    }
  }
}

TEST(Helpers, ReallyWorkAtTheSameTime) {
  const Helpers helpers(3);
  std::atomic<int> come{0};
  helpers.for_each_index(3, [&](std::size_t) {
    ++come;
    while (come < 3) std::this_thread::yield();
  });
  EXPECT_EQ(come, 3);
}

TEST(Helpers, ServeSeveralThatAskAtOnce) {
  const Helpers helpers(2);
  std::vector<int> sums(4);
  {
    std::vector<std::jthread> askers;
    for (int& sum : sums)
      askers.emplace_back([&helpers, &sum] {
        for (int round = 0; round < 200; ++round) {
          std::vector<int> squares(30);
          helpers.for_each_index(squares.size(), [&](std::size_t i) { squares[i] = static_cast<int>(i * i); });
          sum += std::accumulate(squares.begin(), squares.end(), 0);
        }
      });
  }
  for (int sum : sums) EXPECT_EQ(sum, 200 * 8555);
}

}  // namespace
}  // namespace sculpt
