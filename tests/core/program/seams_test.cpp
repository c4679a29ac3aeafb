// Where programs are parted, in real plans: on the way out the tool touches nothing that stands, links touch nothing,
// and it ends outside. By brute force.
#include "core/program/seams.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "core/base/error.hpp"
#include "core/collision/scene.hpp"
#include "tests/core/plan/jobs.hpp"

namespace sculpt {
namespace {

/// Distance of a point from the nearest voxel that stands (voxel edges).
double distance_to(const VoxelSet& standing, const Vec3& point) {
  double least = 2;
  for (int k = 0; k < standing.n(); ++k)
    for (int j = 0; j < standing.n(); ++j)
      for (int i = 0; i < standing.n(); ++i) {
        if (!standing.contains({i, j, k})) continue;
        const Vec3 low(i, j, k);
        least = std::min(least, (point - point.cwiseMax(low).cwiseMin(Vec3(low + Vec3::Ones()))).norm());
      }
  return least;
}

PlanPath plan(const char* cell, int n, std::uint64_t seed) {
  Job job;
  job.cell = shipped_cell_files(cell);
  job.mesh = binvox_file(random_target(n, seed), job.cell);
  job.resolution = n;
  job.seed = seed;
  const std::filesystem::path file = std::filesystem::temp_directory_path() / ("seams_" + std::to_string(getpid()));
  run_job(job, file, {});
  std::ifstream in(file, std::ios::binary);
  PlanPath path(in);
  std::filesystem::remove(file);
  return path;
}

TEST(Seams, TheToolLeavesWithoutTouching) {
  constexpr int n = 8;
  std::size_t ways = 0;
  for (const char* name : {"six-axis-turntable", "ur10e-plinth", "panda-turntable", "gantry"}) {
    SCOPED_TRACE(name);
    const Cell cell = parse_cell(shipped_cell_files(name));
    const PlanPath path = plan(name, n, 5);
    const PathTools tools(path, cell, 0);
    const Grid& grid = path.header().grid;
    const Tool& tool = path.header().tool;
    const double h = grid.voxel_m, ball = tool.ball_radius_m / h, shank = tool.shank_radius_m / h;
    const Scene room(cell, grid, VoxelSet(n));  // nothing stands: links and tool against the room and themselves
    VoxelSet standing(n, true);
    constexpr std::size_t moves = 60;
    std::size_t begin = 0, returning = 0, done = 1;
    for (const Seam& seam : find_seams(path, cell, tools, {moves, false})) {
      EXPECT_LE(returning + seam.point - begin + seam.retreat.size(), moves);
      begin = seam.point;
      returning = seam.retreat.size();
      for (; done <= seam.point; ++done)
        for (int at = 0; at < path.edge_to(done).voxels; ++at) standing.erase(path.voxel_of(done, at));
      Configuration from = path.configuration(seam.point);
      for (const Configuration& to : seam.retreat) {
        for (double share = 0; share <= 1; share += 0.05) {
          const Configuration q = from + share * (to - from);
          const ToolPose pose = room.chain().tool_pose(q);
          const Vec3 at = (pose.ball_m - grid.origin_m) / h;
          ASSERT_GE(distance_to(standing, at), ball - 1e-6);
          for (double along = 0; shank > 0 && along < std::min(tool.stickout_m / h, 2.0 * n); along += 0.25)
            ASSERT_GE(distance_to(standing, at + along * pose.axis), shank - 1e-6);
          ASSERT_EQ(room.contact_at(q), Contact::none);
        }
        from = to;
        ++ways;
      }
      const Vec3 at = (room.chain().tool_pose(from).ball_m - grid.origin_m) / h;
      EXPECT_TRUE((at.array() <= -ball).any() || (at.array() >= n + ball).any()) << at.transpose();
      const Vec3 up = at + n * room.chain().tool_pose(from).axis;
      EXPECT_GE(distance_to(VoxelSet(n, true), (at + up) / 2), ball);
    }
    EXPECT_EQ(find_seams(path, cell, tools, {0, false}).size(), 0U);
    EXPECT_EQ(find_seams(path, cell, tools, {moves, true}).size(), (path.size() - 2) / moves);
    EXPECT_THROW(find_seams(path, cell, tools, {1, false}), InputError);
  }
  EXPECT_GT(ways, 10U);
}

}  // namespace
}  // namespace sculpt
