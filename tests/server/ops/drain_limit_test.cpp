#include "server/ops/drain_limit.hpp"

#include <gtest/gtest.h>
#include <sysexits.h>

namespace sculpt::server {
namespace {

TEST(DrainLimit, EndsAProcessThatDoesNotEnd) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto hang = [] {
    const DrainLimit limit(std::chrono::milliseconds(1));
    while (true) std::this_thread::sleep_for(std::chrono::seconds(1));
  };
  EXPECT_EXIT(hang(), testing::ExitedWithCode(EX_TEMPFAIL), "");
}

TEST(DrainLimit, LeavesAnOrderlyEndAlone) {
  const DrainLimit limit(std::chrono::hours(1));
}

}  // namespace
}  // namespace sculpt::server
