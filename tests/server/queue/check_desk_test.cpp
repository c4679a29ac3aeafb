#include "server/queue/check_desk.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>

#include "tests/server/fake_planner.hpp"

namespace sculpt::server {
namespace {

TEST(CheckDesk, NobodyWaitsForTheTasksOfAnother) {
  Gate gate;
  std::atomic<int> done = 0;
  std::promise<void> last;
  CheckDesk desk(3);
  for (int i = 0; i < 60; ++i)
    desk.add("many", [&](const std::stop_token& stop) {
      gate.pass(stop);
      ++done;
    });
  for (int i = 0; i < 5; ++i) {
    std::promise<void> ran;
    desk.add("few", [&](const std::stop_token&) { ran.set_value(); });
    ran.get_future().wait();
  }
  EXPECT_EQ(done, 0);
  gate.open();
  desk.add("many", [&](const std::stop_token&) { last.set_value(); });
  last.get_future().wait();
}

TEST(CheckDesk, SeveralTasksOfOneClientRunAtOnceButNeverOnAllThreads) {
  Gate gate;
  std::atomic<int> at_once = 0, most = 0;
  std::vector<std::promise<void>> ended(20);
  CheckDesk desk(4);
  for (std::promise<void>& end : ended)
    desk.add("one", [&](const std::stop_token& stop) {
      const int now = ++at_once;
      int before = most;
      while (before < now && !most.compare_exchange_weak(before, now)) {
      }
      if (now == 3) gate.open();
      gate.pass(stop);
      --at_once;
      end.set_value();
    });
  for (std::promise<void>& end : ended) end.get_future().wait();
  EXPECT_EQ(most, 3);
}

TEST(CheckDesk, AStopEndsWhatRunsAndDropsWhatWaits) {
  std::atomic<int> began = 0, ended = 0;
  Gate gate;
  std::promise<void> first;
  CheckDesk desk(2);
  for (int i = 0; i < 3; ++i)
    desk.add("one", [&](const std::stop_token& stop) {
      if (++began == 1) first.set_value();
      try {
        gate.pass(stop);
      } catch (const Cancelled&) {
        ++ended;
      }
    });
  first.get_future().wait();
  desk.stop();
  EXPECT_EQ(began, 1);
  EXPECT_EQ(ended, 1);
}

}  // namespace
}  // namespace sculpt::server
