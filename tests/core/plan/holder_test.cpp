// A tool with a holder, from the cell file to the replay.
#include <gtest/gtest.h>

#include "core/collision/clearance.hpp"
#include "core/verify/verify.hpp"
#include "tests/core/plan/jobs.hpp"
#include "tests/core/plan/soundness.hpp"

namespace sculpt {
namespace {

/// The shipped cell with its tool as it is, but without the holder that grips it.
CellFiles cell_without_holder() {
  CellFiles files = shipped_cell_files("panda-turntable-6mm");
  const std::size_t from = files.cell_json.find("\"holder\": ["), to = files.cell_json.find(']', from);
  EXPECT_NE(from, std::string::npos);
  files.cell_json.replace(from, to + 1 - from, "\"holder\": []");
  return files;
}

/// Walls all around a shaft that is two voxels wide (25 mm) and goes down to the floor.
VoxelSet shaft() {
  VoxelSet target(16, true);
  for (int k = 0; k < 16; ++k)
    for (int j : {7, 8})
      for (int i : {7, 8}) target.erase({i, j, k});
  return target;
}

TEST(Holder, NeverComesNearTheLinkBeforeTheLastJointWhichIsNotCheckedAgainstIt) {
  const Cell cell = parse_cell(shipped_cell_files("panda-turntable-6mm"));
  const Chain chain = cell.chain();
  const auto bodies = make_bodies(cell, make_tool(cell.tool, 0.0125));
  const int link6 = cell.robot.find_link("link6");
  Configuration q = cell.home(chain);
  int compared = 0;
  for (q[chain.dof() - 1] = -2.8; q[chain.dof() - 1] < 2.8; q[chain.dof() - 1] += 0.2) {
    std::vector<Frame> at;
    chain.link_poses(q, at);
    const auto pose = [&](const Body& body) { return at[static_cast<std::size_t>(body.link)]; };
    for (const Body& holder : bodies)
      for (const Body& link : bodies) {
        if (holder.link != cell.tool_link || holder.tool || link.link != link6) continue;
        EXPECT_FALSE(near_body(holder, pose(holder), link, pose(link), 0.01));
        ++compared;
      }
  }
  EXPECT_GT(compared, 20);
}

TEST(Holder, BustIsCarvedWithTheSixMillimetreTool) {
  const auto mesh = std::filesystem::path(SOURCE_DIR) / "config/samples/bust.stl";
  Job job;
  job.cell = shipped_cell_files("panda-turntable-6mm");
  job.mesh = {read_file(mesh), "stl", "bust.stl"};
  job.resolution = 16;
  const ScratchFile file;
  const JobResult result = run_job(job, file.path(), {});
  expect_sound(result);
  EXPECT_GT(result.report.voxels.removed, 3500u);
}

TEST(Holder, StaysOutOfADeepShaftAndWhatItCannotReachIsLeft) {
  const ScratchFile file;
  const JobResult result = run_job(make_job(shipped_cell_files("panda-turntable-6mm"), shaft()), file.path(), {});
  expect_sound(result);
  EXPECT_GT(result.report.voxels.removed, 0u);
  const auto left = left_of(result);
  for (int k = 0; k < 16; ++k) {
    const double depth_m = 0.2 - (k + 0.5) * 0.0125;
    EXPECT_EQ(left.count({7, 8, k}), depth_m > 0.08 ? 1u : 0u) << "k = " << k;
  }
  for (const auto& [voxel, reason] : left) EXPECT_EQ(reason, Reason::tool_cannot_reach);
}

TEST(Holder, ThatEntersTheShaftIsFoundByTheReplay) {
  const ScratchFile file;
  const JobResult result = run_job(make_job(cell_without_holder(), shaft()), file.path(), {});
  expect_sound(result);
  std::ifstream in(file.path(), std::ios::binary);
  const Cell with_holder = parse_cell(shipped_cell_files("panda-turntable-6mm"));
  const Verdict verdict = verify_trajectory(in, with_holder, result.voxels, {});
  EXPECT_FALSE(verdict.clean);
  ASSERT_FALSE(verdict.findings.empty());
  EXPECT_NE(verdict.findings.front().sentence.find("link spindle_nose and the material touch"), std::string::npos)
      << verdict.findings.front().sentence;
}

}  // namespace
}  // namespace sculpt
