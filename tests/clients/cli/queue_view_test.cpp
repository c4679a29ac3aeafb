#include "clients/cli/queue_view.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace sculpt::cli {
namespace {

/// A daemon with jobs in many states, one of which runs in `stage`.
Json busy_queue(const std::string& stage) {
  const Json running{{"job", "01M7XRMDB8NWM1BF9DPP1KFA0R"},
                     {"state", "running"},
                     {"priority", -100},
                     {"mesh", "a-mesh-with-a-long-name.stl"},
                     {"resolution", 1024},
                     {"progress", {{"stage", stage}, {"done", 3}, {"total", 3}}}};
  Json waiting = running;
  waiting.erase("progress");
  waiting["state"] = "quarantined";
  return {{"server",
           {{"server", "sculptd/0.1.0"},
            {"uptime_s", 8640000},
            {"workers", 16},
            {"jobs",
             {{"queued", 100000},
              {"running", 16},
              {"paused", 1234},
              {"held", 4321},
              {"succeeded", 123456},
              {"failed", 99},
              {"cancelled", 77},
              {"quarantined", 3},
              {"expired", 12}}}}},
          {"jobs", {running, waiting}}};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(QueueView, At80ColumnsNothingIsCutOff) {
  for (const char* stage : {"load", "voxelize", "octree", "plan", "verify", "write"}) {
    const std::string whole = queue_text(busy_queue(stage), 200, 0), narrow = queue_text(busy_queue(stage), 80, 0);
    for (const std::string& line : lines_of(narrow)) EXPECT_LE(line.size(), 80u) << line;
    for (const std::string word : {"01M7XRMDB8NWM1BF9DPP1KFA0R", "running", "-100", "1024", "100%", "PROGRESS",
                                   "12 expired", "123456 succeeded", stage}) {
      EXPECT_NE(whole.find(word), std::string::npos) << word;
      EXPECT_NE(narrow.find(word), std::string::npos) << word << " is cut off in\n" << narrow;
    }
  }
}

TEST(QueueView, WhereThereIsRoomItDrawsABar) {
  const Json queue = busy_queue("plan");
  EXPECT_NE(queue_text(queue, 0, 0).find("[############] 100% plan"), std::string::npos);
  EXPECT_NE(queue_text(queue, 103, 0).find("[############] 100% plan"), std::string::npos);
  EXPECT_EQ(queue_text(queue, 102, 0).find("["), std::string::npos);
}

TEST(QueueView, OnASmallScreenItSaysHowManyAreLeftOut) {
  const auto lines = lines_of(queue_text(busy_queue("plan"), 80, 6));
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_EQ(lines.back(), "... and 2 more");
}

}  // namespace
}  // namespace sculpt::cli
