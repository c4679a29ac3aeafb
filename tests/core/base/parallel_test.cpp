#include "core/base/parallel.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace sculpt {
namespace {

TEST(Parallel, EveryIndexIsVisitedOnceAtAnyNumberOfThreads) {
  for (int threads : {0, 1, 2, 5}) {
    for (std::size_t count : {0u, 1u, 3u, 1000u}) {
      std::vector<int> visits(count);
      for_each_index(threads, count, [&](std::size_t i) { ++visits[i]; });
      EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), static_cast<std::ptrdiff_t>(count));
    }
  }
}

TEST(Parallel, TheFirstExceptionByIndexComesThroughAndTheRestIsDone) {
  for (int threads : {1, 3}) {
    std::atomic<int> done{0};
    std::string said;
    try {
      for_each_index(threads, 100, [&](std::size_t i) {
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

}  // namespace
}  // namespace sculpt
