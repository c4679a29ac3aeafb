// Cells as users write them: mesh links, short tools, no turntable. What sweeps cut there, and that it replays clean.
#include <gtest/gtest.h>

#include "tests/core/plan/jobs.hpp"
#include "tests/core/plan/soundness.hpp"

namespace sculpt {
namespace {

Job job_for(CellFiles cell, const VoxelSet& target, std::uint64_t seed) {
  Job job;
  job.mesh = binvox_file(target, cell);
  job.cell = std::move(cell);
  job.resolution = target.n();
  job.seed = seed;
  return job;
}

JobResult plan(const Job& job) {
  const ScratchFile file;
  JobResult result = run_job(job, file.path(), {});
  expect_sound(result);
  EXPECT_TRUE(result.report.verify.clean);
  return result;
}

/// Of what some tool comes to, at least so many in a hundred are cut by sweeps.
void expect_swept(const JobResult& result, double percent) {
  ASSERT_TRUE(result.report.sweep);
  const auto& [cut, left, uncovered] = *result.report.sweep;
  EXPECT_LE(uncovered, left);
  EXPECT_GE(100.0 * static_cast<double>(cut), percent * static_cast<double>(cut + left));
}

class SharedCell : public testing::TestWithParam<const char*> {};

// Links of up to 9120 triangles each: with a cover by 32 boxes no field had a bubble beside the table.
TEST_P(SharedCell, OfMeshLinksIsCarvedBySweeps) {
  const auto path = shared_data() / "cells" / (std::string(GetParam()) + ".json");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "shared data folder without cells/" << GetParam() << ".json";
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_swept(plan(job_for(read_cell_files(path), random_target(16, seed), seed)), 99);
  }
}
INSTANTIATE_TEST_SUITE_P(Robots, SharedCell, testing::Values("kr16", "kr120"));

// The holder comes to where stock stood: fields are opened for what really stands.
TEST(AnyCell, WithAShortToolIsCarvedBySweeps) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const int n = seed == 0 ? 16 : 8;
    expect_swept(plan(job_for(shipped_cell_files("panda-turntable-6mm"), random_target(n, seed), seed)),
                 n == 8 ? 90 : 98);
  }
}

TEST(AnyCell, WithAShortToolGivesTheSameBytesAtAnyNumberOfThreads) {
  Job job = job_for(shipped_cell_files("panda-turntable-6mm"), random_target(8, 5), 5);
  const JobResult one = plan(job);
  job.threads = 2;
  const JobResult two = plan(job);
  EXPECT_EQ(one.report.plan_sha256, two.report.plan_sha256);
  EXPECT_EQ(one.report.sweep->cut, two.report.sweep->cut);
}

// A bar on the upper arm that is in a plate on the shoulder along three quarters of the joint's travel, 0.3 m beside
// its axis: the planner takes them for a bearing, the replay does not.
TEST(AnyCell, WhatTheReplayWouldFindAtHomeIsRefusedBeforePlanning) {
  Job job = job_for(shipped_cell_files("panda-turntable"), random_target(8, 1), 0);
  std::string& urdf = job.cell.files.begin()->second;
  const auto add = [&urdf](const std::string& link, const std::string& shape) {
    const std::string head = "<link name=\"" + link + "\">";
    urdf.insert(urdf.find(head) + head.size(), "<collision>" + shape + "</collision>");
  };
  add("link1", "<origin xyz='0.075 0.3 0'/><geometry><box size='0.09 0.02 0.24'/></geometry>");
  add("link2", "<origin xyz='0.1 0 0.3'/><geometry><box size='0.02 0.02 0.02'/></geometry>");
  try {
    plan(job);
    FAIL() << "it was planned";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), "cell_invalid");
    EXPECT_NE(std::string(error.what()).find("link1 and link link2 touch at home"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("ignore_pairs"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sculpt
