// What every finished plan must be, whatever the robot.
#pragma once

#include <gtest/gtest.h>

#include <map>

#include "core/material/cavities.hpp"
#include "core/plan/plan.hpp"

namespace sculpt {

/// Clean in the replay, and complete about what it left.
inline void expect_sound(const JobResult& result) {
  const Report& report = result.report;
  EXPECT_TRUE(report.verify.clean) << (report.findings.empty() ? "" : report.findings.front());
  EXPECT_EQ(report.verify.voxels_checked, report.voxels.removed);
  if (report.robot != "gantry" && report.voxels.loose_keep == 0) {
    EXPECT_EQ(report.voxels.freed, 0u);
  }
  EXPECT_EQ(report.voxels.removed + report.voxels.residue, report.voxels.remove);
  EXPECT_EQ(report.voxels.air + report.voxels.keep + report.voxels.remove, report.voxels.total);
  EXPECT_EQ(result.residue.size(), report.voxels.residue);
  const VoxelSet enclosed = find_enclosed(result.voxels);
  for (const Residue& left : result.residue) {
    EXPECT_EQ(result.voxels.label(left.voxel), Label::remove);
    EXPECT_EQ(left.reason == Reason::enclosed, enclosed.contains(left.voxel));
  }
}

/// What was left, and why.
inline std::map<Voxel, Reason> left_of(const JobResult& result) {
  std::map<Voxel, Reason> left;
  for (const Residue& residue : result.residue) left[residue.voxel] = residue.reason;
  return left;
}

}  // namespace sculpt
