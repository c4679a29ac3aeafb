#include "clients/cli/progress_line.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

namespace sculpt::cli {
namespace {

using std::chrono::milliseconds;

/// A pipe in place of stderr, and a clock that only the test moves.
class ProgressLineTest : public testing::Test {
 protected:
  ProgressLineTest() {
    if (pipe2(ends_.data(), O_NONBLOCK) != 0) throw std::runtime_error("no pipe");
  }
  ~ProgressLineTest() override {
    for (const int end : ends_) close(end);
  }

  ProgressLine line(PlainLines plain) {
    return {ends_[1], plain, [this] { return now_; }};
  }

  /// What was written since the last look.
  std::string written() const {
    std::array<char, 4096> bytes;
    const ssize_t n = read(ends_[0], bytes.data(), bytes.size());
    return n > 0 ? std::string(bytes.data(), static_cast<std::size_t>(n)) : std::string();
  }

  ProgressLine::Clock::time_point now_{std::chrono::hours(1)};

 private:
  std::array<int, 2> ends_{};
};

TEST_F(ProgressLineTest, WorkOfLessThanASecondSaysNothing) {
  ProgressLine progress = line(PlainLines::each_second);
  for (std::uint64_t done = 0; done < 10; ++done) {
    progress.tell(done < 5 ? "load" : "plan", done, 10);
    now_ += milliseconds(99);
  }
  progress.clear();
  EXPECT_EQ(written(), "");
}

TEST_F(ProgressLineTest, LongWorkSaysOneLineASecond) {
  ProgressLine progress = line(PlainLines::each_second);
  for (std::uint64_t done = 0; done <= 25; ++done) {
    progress.tell(done < 15 ? "plan" : "verify", done, 100);
    now_ += milliseconds(100);
  }
  EXPECT_EQ(written(), "plan 10/100\nverify 20/100\n");
}

TEST_F(ProgressLineTest, AStageWithoutCountsIsNamedAlone) {
  ProgressLine progress = line(PlainLines::each_second);
  now_ += milliseconds(1000);
  progress.tell("load", 0, 0);
  EXPECT_EQ(written(), "load\n");
}

TEST_F(ProgressLineTest, AWatcherIsToldOfEachStageAndTenthAtOnce) {
  ProgressLine progress = line(PlainLines::on_change);
  for (const std::uint64_t done : {0, 9, 10, 19, 90}) progress.tell("plan", done, 100);
  progress.tell("verify", 95, 100);
  EXPECT_EQ(written(), "plan 0/100\nplan 10/100\nplan 90/100\nverify 95/100\n");
}

TEST_F(ProgressLineTest, WhereNoLinesAreWantedThereAreNone) {
  ProgressLine progress = line(PlainLines::none);
  now_ += milliseconds(5000);
  progress.tell("plan", 1, 2);
  progress.say("succeeded");
  EXPECT_EQ(written(), "");
}

}  // namespace
}  // namespace sculpt::cli
