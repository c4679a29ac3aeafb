// Real plans, timed: ball and shank of the motion that a controller is given touch nothing that stands, and links do
// not touch either. By brute force, with nothing of what the time law rests on.
#include <gtest/gtest.h>

#include <deque>
#include <fstream>

#include "core/collision/scene.hpp"
#include "core/timing/motion/sampler.hpp"
#include "core/timing/timed_plan.hpp"
#include "tests/core/plan/jobs.hpp"

namespace sculpt {
namespace {

/// Distance of a point from the nearest voxel that stands, up to 1.5 (voxel edges).
double distance_to(const VoxelSet& standing, const Vec3& point) {
  const int n = standing.n();
  double least = 1.5;
  const Voxel at{static_cast<int>(std::floor(point.x())), static_cast<int>(std::floor(point.y())),
                 static_cast<int>(std::floor(point.z()))};
  for (int k = std::max(0, at.k - 1); k <= std::min(n - 1, at.k + 1); ++k)
    for (int j = std::max(0, at.j - 1); j <= std::min(n - 1, at.j + 1); ++j)
      for (int i = std::max(0, at.i - 1); i <= std::min(n - 1, at.i + 1); ++i) {
        if (!standing.contains({i, j, k})) continue;
        const Vec3 low(i, j, k), nearest = point.cwiseMax(low).cwiseMin(Vec3(low + Vec3::Ones()));
        least = std::min(least, (point - nearest).norm());
      }
  return least;
}

/// The tool against all of the cube that was not cut before the point that the motion comes from; what is cut on the
/// edges beside it may be touched.
class Material {
 public:
  Material(const PlanPath& path, int n) : path_(path), standing_(n, true) {}

  void go_to(std::size_t point) {
    for (; done_ < std::min(point + 2, path_.size()); ++done_)
      for (int at = 0; at < path_.edge_to(done_).voxels; ++at) standing_.erase(path_.voxel_of(done_, at));
  }
  const VoxelSet& standing() const { return standing_; }

 private:
  const PlanPath& path_;
  VoxelSet standing_;
  std::size_t done_ = 1;
};

void expect_free(const char* cell_name, int n, double feed_m_s, std::uint64_t seed) {
  SCOPED_TRACE(std::string(cell_name) + " seed " + std::to_string(seed));
  Job job;
  job.cell = shipped_cell_files(cell_name);
  job.mesh = binvox_file(random_target(n, seed), job.cell);
  job.resolution = n;
  job.seed = seed;
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("timed_motion_" + std::to_string(getpid()));
  run_job(job, file, {});
  const Cell cell = parse_cell(job.cell);
  std::ifstream in(file, std::ios::binary);
  const PlanPath path(in);
  std::filesystem::remove(file);
  const TimedPlan plan = time_plan(path, cell, {feed_m_s, 0.5, {}, 0});
  MotionSampler sampler(path, plan.law);
  const Chain chain = cell.chain();
  const Tool& tool = path.header().tool;
  const Grid& grid = path.header().grid;
  const double h = grid.voxel_m, ball = tool.ball_radius_m / h, shank = tool.shank_radius_m / h;
  Material material(path, n);
  const Scene room(cell, grid, VoxelSet(n));  // nothing stands: links and tool against the room and themselves
  std::size_t samples = 0;
  for (double time = 0; time < sampler.duration_s(); time += 0.004, ++samples) {
    const Configuration q = sampler.at(time).q;
    material.go_to(sampler.point_at(time));
    const ToolPose pose = chain.tool_pose(q);
    const Vec3 at = (pose.ball_m - grid.origin_m) / h;
    ASSERT_GE(distance_to(material.standing(), at), ball - 1e-6) << time;
    for (double along = 0; shank > 0 && along < tool.stickout_m / h && along < 2 * n; along += 0.25) {
      ASSERT_GE(distance_to(material.standing(), at + along * pose.axis), shank - 1e-6) << time;
    }
    if (samples % 16 == 0) {
      ASSERT_EQ(room.contact_at(q), Contact::none) << time;
    }
  }
  EXPECT_GT(samples, 1000u);
}

TEST(TimedMotion, TouchesNothingThatStands) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    expect_free("panda-turntable", 8, 0.1, seed);
    expect_free("ur10e-plinth", 8, 0.2, seed);
  }
  expect_free("gantry", 8, 0.2, 3);
}

}  // namespace
}  // namespace sculpt
