// Milling tools are changed where the cell says.
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/error.hpp"
#include "core/trajectory/reader.hpp"
#include "tests/core/mill/milled_plan.hpp"

namespace sculpt {
namespace {

namespace fs = std::filesystem;

using milled::make_job;
using milled::read;
using milled::scratch;

TEST(ToolChange, IsWhereTheCellSays) {
  Job job = make_job("bust", 16, {"D12", "D6"});
  job.mill->tolerance_m = 5e-4;
  auto cell = nlohmann::json::parse(job.cell.cell_json);
  cell["tool_change"] = {{"a1", 0.9}, {"a5", 1.2}};
  job.cell.cell_json = cell.dump();
  job.threads = 2;
  const fs::path file = scratch("change.ndjson");
  const JobResult result = run_job(job, file, {});
  for (const std::string& finding : result.report.findings) std::cout << finding << "\n";
  EXPECT_TRUE(result.report.verify.clean);
  std::istringstream in(read(file));
  fs::remove(file);
  TrajectoryReader reader(in);
  Configuration expected = reader.header().home;
  expected[1] = 0.9;
  expected[5] = 1.2;
  int changes = 0;
  bool home_since = false;
  Configuration before = reader.header().home;
  while (const auto keyframe = reader.next()) {
    if (keyframe->mill->is_change()) {
      ++changes;
      EXPECT_TRUE(keyframe->q.isApprox(expected, 1e-9)) << keyframe->q.transpose();
      EXPECT_EQ(keyframe->q, before) << "at rest";
    }
    home_since = changes > 0 && (home_since || keyframe->q == reader.header().home);
    before = keyframe->q;
  }
  EXPECT_EQ(changes, 1);
  EXPECT_TRUE(home_since);
}

TEST(ToolChange, TouchesNothing) {
  Job job = make_job("bust", 16, {"D12", "D6"});
  auto cell = nlohmann::json::parse(job.cell.cell_json);
  cell["tool_change"] = {{"a2", -0.9}, {"a3", 1.9}};
  job.cell.cell_json = cell.dump();
  const fs::path file = scratch("touching.ndjson");
  try {
    run_job(job, file, {});
    ADD_FAILURE() << "planned";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), "tools_invalid");
    EXPECT_NE(std::string(error.what()).find("tool_change"), std::string::npos) << error.what();
  }
  fs::remove(file);
}

}  // namespace
}  // namespace sculpt
