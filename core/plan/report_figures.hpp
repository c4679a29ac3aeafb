// What came of each stage -> the figures of the report.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/watch.hpp"
#include "core/collision/scene.hpp"
#include "core/material/octree.hpp"
#include "core/plan/output/path_figures.hpp"
#include "core/plan/report.hpp"
#include "core/verify/verify.hpp"

namespace sculpt {

void count_voxels(Report& report, const VoxelGrid& voxels, const Doubts& doubts, const Octree& octree);
void list_unchecked_links(Report& report, const Scene& scene);
/// `checks`: configurations tested for it.
void count_path(Report& report, const PathFigures& figures, double voxel_m, std::uint64_t checks);
void count_residue(Report& report, const std::vector<Residue>& residue);
void count_replay(Report& report, const Verdict& verdict);
/// `excess`: at each point (m).
ExcessFigures excess_figures(std::vector<double> excess, double tolerance_m);
/// `reachable`: of points that the tools can come to.
void count_surface(Report& report, const SurfaceVerdict& surface, const ExcessFigures& reachable, double tolerance_m);

}  // namespace sculpt
