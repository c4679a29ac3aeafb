#include "core/motion/line.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/trajectory/quantum.hpp"
#include "tests/core/plan/jobs.hpp"

namespace sculpt {
namespace {

TEST(Line, TracksTheLineWithTheAxisHeldOverCertifiedEdges) {
  const Cell cell = parse_cell(shipped_cell_files("panda-turntable"));
  const Grid grid = cell.grid(16);
  const Scene scene(cell, grid, VoxelSet(16));
  int tracked = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const auto point = [&] {
      return Vec3(random.between(-0.09, 0.09), random.between(-0.09, 0.09), random.between(0.02, 0.2));
    };
    const Vec3 from = point(), to = point(), axis = Vec3::UnitZ();
    const auto start = solve_rounded(scene.chain(), {from, axis}, cell.home(scene.chain()));
    if (!start || scene.contact_at(*start) != Contact::none) continue;
    const auto path = track_line(scene, *start, to, axis);
    if (!path) continue;
    ++tracked;
    Configuration before = *start;
    for (const Configuration& q : *path) {
      EXPECT_EQ(scene.certify(before, q), Contact::none);
      EXPECT_EQ(q, rounded(q)) << "what is certified must be what is stored";
      const ToolPose pose = scene.chain().tool_pose(q);
      const Vec3 along = (to - from).normalized(), off = pose.ball_m - from;
      EXPECT_LT((off - off.dot(along) * along).norm(), 1e-6);
      EXPECT_GT(pose.axis.dot(axis), 1 - 1e-8);
      before = q;
    }
    EXPECT_LT((scene.chain().tool_pose(path->back()).ball_m - to).norm(), 1e-6);
  }
  EXPECT_GT(tracked, 20);
}

TEST(Line, ThroughMaterialIsRefusedAndSaysWhy) {
  const Cell cell = parse_cell(shipped_cell_files("panda-turntable"));
  const Grid grid = cell.grid(8);
  VoxelSet wall(8);
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 8; ++j) wall.insert({4, j, k});
  const Scene scene(cell, grid, wall);
  const auto start = solve_rounded(scene.chain(), {grid.centre({1, 4, 3}), Vec3::UnitZ()}, cell.home(scene.chain()));
  ASSERT_TRUE(start);
  Contact contact = Contact::none;
  EXPECT_FALSE(track_line(scene, *start, grid.centre({7, 4, 3}), Vec3::UnitZ(), &contact));
  EXPECT_EQ(contact, Contact::tool_material);
}

}  // namespace
}  // namespace sculpt
