#include "core/verify/mill/tool_scene.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "tests/core/mill/milled_plan.hpp"

namespace sculpt {
namespace {

bool holds(const Shape& shape, const Vec3& point) {
  const Vec3 at = shape.pose.inverse() * point;
  if (shape.kind == ShapeKind::sphere) return at.norm() <= shape.radius_m;
  return at.head<2>().norm() <= shape.radius_m && std::abs(at.z()) <= shape.length_m / 2;
}

TEST(ToolScene, ABallCutterEndsInABall) {
  const Job job = milled::make_job("bust", 16, {"D20"});
  const Cell cell = parse_cell(job.cell);
  const MillTool tool = choose_tools(job.mill->library, {"D20"}).front();
  const StandingVoxels material(VoxelSet(16), 1000 * cell.grid(16).voxel_m, false);
  const ToolScene scene(cell, tool, cell.chain().joints(), material);
  const auto& all = scene.cell.robot.links[static_cast<std::size_t>(cell.tool_link)].shapes;
  const auto& bare = cell.robot.links[static_cast<std::size_t>(cell.tool_link)].shapes;
  Random random(5);
  for (int sample = 0; sample < 20000; ++sample) {
    const double r = tool.cutter.radius_m, up = random.unit() * tool.cutter.flute_m, off = 1.5 * r * random.unit();
    const double wide = up < r ? std::sqrt(r * r - (r - up) * (r - up)) : r;
    if (std::abs(off - wide) < 1e-9) continue;
    const bool is_held =
        std::any_of(all.begin() + static_cast<std::ptrdiff_t>(bare.size()), all.end(), [&](const Shape& shape) {
          return holds(shape, {off, 0, tool.stickout_m - up});
        });
    EXPECT_EQ(is_held, off < wide) << up << " above the tip, " << off << " beside the axis";
  }
}

}  // namespace
}  // namespace sculpt
