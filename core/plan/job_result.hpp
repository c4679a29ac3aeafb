// What comes of a job.
#pragma once

#include <vector>

#include "core/material/voxel_grid.hpp"
#include "core/motion/residue.hpp"
#include "core/plan/report.hpp"

namespace sculpt {

struct JobResult {
  Report report;
  VoxelGrid voxels;
  Grid grid;
  std::vector<Residue> residue;
};

/// What stands when the plan has been carried out: the target, and what was left.
VoxelSet find_left(const JobResult& result);

}  // namespace sculpt
