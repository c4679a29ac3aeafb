#include "core/verify/mill/tool_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.hpp"
#include "core/cell/milling/tool_library.hpp"
#include "tests/core/cell/sample_robots.hpp"

namespace sculpt {
namespace {

bool holds(const Shape& shape, const Vec3& point) {
  const Vec3 at = shape.pose.inverse() * point;
  if (shape.kind == ShapeKind::sphere) return at.norm() <= shape.radius_m;
  return at.head<2>().norm() <= shape.radius_m && std::abs(at.z()) <= shape.length_m / 2;
}

TEST(ToolScene, ABallCutterEndsInABall) {
  const Cell cell = shipped_cell("studio");
  const MillTool tool = choose_tools(read_tool_library("carving", {SOURCE_DIR "/config/tools"}), {"D20"}).front();
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
