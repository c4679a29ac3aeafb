// The meshes of tests/scenarios (scripts/make-scenarios) as jobs.
#pragma once

#include "tests/core/plan/jobs.hpp"

namespace sculpt {

/// `name` is a file of tests/scenarios without its extension, `cell` a shipped cell. The meshes are in metres of a
/// stock of 0.2 m.
inline Job scenario(const std::string& name, const std::string& cell, int resolution,
                    const std::string& search = "octree") {
  const std::string extension = name == "empty" ? "binvox" : "stl", file = name + "." + extension;
  Job job;
  job.mesh = {read_file(std::filesystem::path(SOURCE_DIR) / "tests/scenarios" / file), extension, file};
  job.cell = shipped_cell_files(cell);
  job.resolution = resolution;
  job.search = parse_search(search);
  const double edge_m = 0.2 / 16;
  job.placement.scale_m = 1;
  // The vase's axis and the single voxel would stand between voxels at 16, the figure is not in the middle of its page.
  if (name == "vase") job.placement.offset_m = Vec3(0.5, 0.5, 0) * edge_m;
  if (name == "single") job.placement.offset_m = Vec3(0.5, 0.5, 7) * edge_m;
  if (name == "quadtree") job.placement.offset_m = Vec3(3, 2, 0) * edge_m;
  return job;
}

}  // namespace sculpt
