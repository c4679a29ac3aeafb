#include "server/http/metrics.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "server/files/data_folder.hpp"
#include "server/queue/stage_times.hpp"
#include "tests/server/temp_folder.hpp"

namespace sculpt::server {
namespace {

struct Quiet {
  TempFolder folder;
  DataFolder data{folder.path()};
  std::unique_ptr<JobStore> store = open_sqlite_store(data.database());
  Counters counters;
  MetricSources sources{*store, counters, 2, std::chrono::steady_clock::now()};
};

bool has_line(const std::string& text, const std::string& line) {
  return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
}

std::uint64_t count_in(const std::string& histogram) {
  return std::stoull(histogram.substr(histogram.rfind(' ') + 1));
}

TEST(Metrics, CountWhatHappened) {
  Quiet quiet;
  const std::uint64_t commits = count_in(quiet.store->commit_times().text("t", ""));
  quiet.store->submit({"", {}, "{}", "", 0});
  quiet.store->submit({"", {}, "{}", "", 0});
  quiet.store->claim();
  quiet.counters.connections = 5;
  quiet.counters.bytes_in = 77;
  const std::string text = metrics_text(quiet.sources, 3, quiet.folder.path());
  EXPECT_TRUE(has_line(text, "sculptd_jobs{state=\"queued\"} 1")) << text;
  EXPECT_TRUE(has_line(text, "sculptd_jobs{state=\"running\"} 1")) << text;
  EXPECT_TRUE(has_line(text, "sculptd_workers 2")) << text;
  EXPECT_TRUE(has_line(text, "sculptd_connections 3")) << text;
  EXPECT_TRUE(has_line(text, "sculptd_connections_total 5")) << text;
  EXPECT_TRUE(has_line(text, "sculptd_received_bytes_total 77")) << text;
  EXPECT_TRUE(has_line(text, "sculptd_commit_seconds_count " + std::to_string(commits + 3))) << text;
}

// Each figure is announced by HELP and TYPE of its own name, once.
TEST(Metrics, AreInTheTextFormat) {
  Quiet quiet;
  std::istringstream lines(metrics_text(quiet.sources, 0, quiet.folder.path()));
  std::string line, announced;
  std::set<std::string> names;
  while (std::getline(lines, line)) {
    if (line.starts_with("# HELP ")) {
      announced = line.substr(7, line.find(' ', 7) - 7);
      EXPECT_TRUE(names.insert(announced).second) << line;
    } else if (line.starts_with("# TYPE ")) {
      EXPECT_TRUE(line.starts_with("# TYPE " + announced + " ")) << line;
    } else {
      EXPECT_TRUE(line.starts_with(announced)) << line;
      std::size_t end = 0;
      const std::string value = line.substr(line.rfind(' ') + 1);
      EXPECT_GE(std::stod(value, &end), 0) << line;
      EXPECT_EQ(end, value.size()) << line;
    }
  }
  EXPECT_TRUE(names.contains("process_resident_memory_bytes"));
}

TEST(Histogram, BucketsAddUp) {
  Histogram times;
  times.add(std::chrono::microseconds(100));
  times.add(std::chrono::milliseconds(2));
  times.add(std::chrono::hours(24));
  const std::string text = times.text("t", "stage=\"plan\"");
  EXPECT_TRUE(has_line(text, "t_bucket{stage=\"plan\",le=\"0.0001\"} 1")) << text;
  EXPECT_TRUE(has_line(text, "t_bucket{stage=\"plan\",le=\"0.001\"} 1")) << text;
  EXPECT_TRUE(has_line(text, "t_bucket{stage=\"plan\",le=\"0.003\"} 2")) << text;
  EXPECT_TRUE(has_line(text, "t_bucket{stage=\"plan\",le=\"36000\"} 2")) << text;
  EXPECT_TRUE(has_line(text, "t_bucket{stage=\"plan\",le=\"+Inf\"} 3")) << text;
  EXPECT_TRUE(has_line(text, "t_count{stage=\"plan\"} 3")) << text;
}

TEST(StageTimes, EveryStageCountsOnceHoweverTheRunEnds) {
  Counters counters;
  const RunJob run = with_stage_times(
      [](const JobRecord&, const Watch& watch) -> Ending {
        for (int i = 0; i < 3; ++i) watch.step(Stage::plan, i, 3);
        watch.step(Stage::verify, 0, 1);
        throw Cancelled{};
      },
      counters);
  EXPECT_THROW(run({}, {}), Cancelled);
  EXPECT_TRUE(has_line(counters.stage_times[static_cast<int>(Stage::plan)].text("t", ""), "t_count 1"));
  EXPECT_TRUE(has_line(counters.stage_times[static_cast<int>(Stage::verify)].text("t", ""), "t_count 1"));
  EXPECT_TRUE(has_line(counters.stage_times[static_cast<int>(Stage::octree)].text("t", ""), "t_count 0"));
}

}  // namespace
}  // namespace sculpt::server
