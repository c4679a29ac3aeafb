// A job that begins with what another one left.
#include "core/material/clamping.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "core/plan/intake.hpp"
#include "core/plan/job_key.hpp"
#include "tests/core/plan/jobs.hpp"

namespace sculpt {
namespace {

constexpr int n = 8;
const Vec3 half_turn(std::numbers::pi, 0, 0), quarter(0, std::numbers::pi / 2, 0);

/// A box on its mouth: what is in it can be reached once it is turned over.
VoxelSet hood() {
  VoxelSet target(n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < 6; ++k)
        if (i < 2 || i > 5 || j < 2 || j > 5 || k > 3) target.insert({i, j, k});
  return target;
}

MeshFile left_file(const JobResult& result) {
  return {write_binvox(find_left(result), result.grid), "binvox", "left.binvox"};
}

Job continued(const Job& job, const JobResult& result, const Vec3& rotation_rad) {
  Job next = job;
  next.clampings.push_back({left_file(result), rotation_rad});
  return next;
}

std::string refusal(const Job& job) {
  try {
    check_job(job, {});
    return "accepted";
  } catch (const InputError& error) {
    return error.code();
  }
}

TEST(Clampings, TheSecondRemovesWhatTheFirstCouldNotReach) {
  const ScratchFile file;
  const Job first = make_job(shipped_cell_files("gantry"), hood());
  const JobResult carved = run_job(first, file.path(), {});
  constexpr std::uint64_t hidden = 4 * 4 * 4;
  ASSERT_EQ(carved.report.voxels.residue, hidden);

  const JobResult rest = run_job(continued(first, carved, half_turn), file.path(), {});
  EXPECT_TRUE(rest.report.verify.clean);
  EXPECT_EQ(rest.report.voxels.keep, carved.report.voxels.keep);
  EXPECT_EQ(rest.report.voxels.removed, hidden);
  EXPECT_EQ(rest.report.voxels.residue, 0u);
  EXPECT_EQ(find_left(rest), clamp_anew(carved.voxels, find_left(carved), cube_turn(half_turn).value()).keep);
}

TEST(Clampings, TurnsAddUpFromJobToJob) {
  const ScratchFile file;
  const Job first = make_job(shipped_cell_files("gantry"), hood());
  const JobResult one = run_job(first, file.path(), {});
  const Job second = continued(first, one, half_turn);
  const JobResult two = run_job(second, file.path(), {});
  const Job third = continued(second, two, half_turn);
  const VoxelGrid voxels = make_voxels(third, two.grid, {});
  EXPECT_EQ(voxels.keep, hood()) << "two half turns are none, and it stood on the floor";
  EXPECT_EQ(voxels.stock, voxels.keep);
}

TEST(Clampings, WhatDoesNotFitIsRefused) {
  const ScratchFile file;
  const Job first = make_job(shipped_cell_files("gantry"), hood());
  const JobResult carved = run_job(first, file.path(), {});
  EXPECT_EQ(refusal(continued(first, carved, half_turn)), "accepted");
  EXPECT_EQ(refusal(continued(first, carved, {0.5, 0, 0})), "placement_invalid");
  Job other = continued(first, carved, half_turn);
  other.mesh = binvox_file(VoxelSet(n, true), other.cell);
  EXPECT_EQ(refusal(other), "target_outside_stock");
  other = continued(first, carved, half_turn);
  std::string& json = other.cell.cell_json;
  const std::size_t size = json.find("\"size_m\": 0.2");
  ASSERT_NE(size, std::string::npos) << json;
  json.replace(size, 13, "\"size_m\": 0.3");
  EXPECT_EQ(refusal(other), "cell_invalid");
  Job finer = make_job(shipped_cell_files("gantry"), random_target(16, 1));
  finer.clampings.push_back({left_file(carved), half_turn});
  EXPECT_EQ(refusal(finer), "resolution_invalid");
}

TEST(Clampings, BelongToTheJobsKeyAndToItsMemory) {
  const ScratchFile file;
  const Job first = make_job(shipped_cell_files("gantry"), hood());
  const JobResult carved = run_job(first, file.path(), {});
  const Job second = continued(first, carved, half_turn), same = continued(first, carved, half_turn);
  EXPECT_EQ(job_key(second), job_key(same));
  EXPECT_NE(job_key(second), job_key(first));
  EXPECT_NE(job_key(second), job_key(continued(first, carved, quarter)));
  Job other = second;
  other.clampings[0].left.bytes.back() ^= 1;
  EXPECT_NE(job_key(second), job_key(other));
  EXPECT_EQ(predict_memory(sizes_of(second)) - predict_memory(sizes_of(first)), second.clampings[0].left.bytes.size());
}

}  // namespace
}  // namespace sculpt
