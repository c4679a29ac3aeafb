#include "core/mill/left/cures.hpp"

#include <gtest/gtest.h>

#include "core/cell/cell.hpp"
#include "core/cell/milling/tool_library.hpp"
#include "core/mill/map/tool_frame.hpp"
#include "tests/core/material/shapes.hpp"
#include "tests/core/mill/milled_plan.hpp"

namespace sculpt {
namespace {

constexpr int n = 64;
constexpr double size_m = 0.1;

/// A block with a slot of this width from side to side, down to 30 mm from its floor: 70 mm deep, or shut by a lid.
Mesh slotted(double width_m, bool has_lid) {
  const double half = size_m / 2, inner = width_m / 2;
  const auto slab = [&](const Vec3& low, const Vec3& high) {
    const Vec3 corner(-half, -half, 0.3);
    return shapes::box(corner + low, corner + high);
  };
  Mesh mesh = shapes::joined(slab({0, 0, 0}, {half - inner, size_m, size_m}),
                             slab({half + inner, 0, 0}, {size_m, size_m, size_m}));
  mesh = shapes::joined(mesh, slab({half - inner, 0, 0}, {half + inner, size_m, 0.03}));
  // Only from above: the ends are shut.
  mesh = shapes::joined(mesh, slab({half - inner, 0, 0}, {half + inner, 0.02, size_m}));
  mesh = shapes::joined(mesh, slab({half - inner, 0.08, 0}, {half + inner, size_m, size_m}));
  return has_lid ? shapes::joined(mesh, slab({0, 0, 0.09}, {size_m, size_m, size_m})) : mesh;
}

/// What is said of a voxel in the middle of the slot, just above its floor.
std::vector<Cure> cures_in(const Mesh& part, const std::vector<std::string>& names, int threads = 1) {
  const Cell cell = parse_cell(milled::make_job("bust", n, {"D6"}).cell);
  const Grid grid{n, size_m / n, {-size_m / 2, -size_m / 2, 0.3}};
  const VoxelGrid voxels{VoxelSet(n), VoxelSet(n)};
  const std::vector<MillTool> tools =
      choose_tools(read_tool_library(SOURCE_DIR "/config/tools/carving.json", {}), names);
  const MillJob job{cell, grid, voxels, part, tools, {}, {}, {}};
  VoxelSet left(n);
  left.insert({n / 2, n / 2, 20});
  PartViews views(part, mill_directions().size());
  const Helpers helpers(threads);
  const Watch watch;
  return find_cures(job, left, views, {0, helpers, watch});
}

TEST(Cures, AToolThatIsThinEnoughButShortMustBeLonger) {
  // The slot is 8 mm wide: D3 fits, but what holds it does not. 80 mm of D6 are free, the slot is 70 mm deep.
  const std::vector<Cure> cures = cures_in(slotted(0.008, false), {"D20", "D3"});
  ASSERT_EQ(cures.size(), 1U);
  EXPECT_EQ(cures[0].obstacle, Obstacle::length);
  EXPECT_DOUBLE_EQ(cures[0].diameter_m, 0.003);
  EXPECT_GT(cures[0].free_m, 0.064);
  EXPECT_LT(cures[0].free_m, 0.071);
  EXPECT_DOUBLE_EQ(cures[0].share, 1);
  EXPECT_EQ(cures[0].sentence().substr(0, 9), "D3 with 6") << cures[0].sentence();
}

TEST(Cures, AToolThatFitsHadNoWay) {
  const std::vector<Cure> cures = cures_in(slotted(0.008, false), {"D20", "D6"});
  ASSERT_EQ(cures.size(), 1U);
  EXPECT_EQ(cures[0].obstacle, Obstacle::way);
  EXPECT_DOUBLE_EQ(cures[0].diameter_m, 0.006);
  // Its shank has 1 mm of room on each side, less where it does not go just in the middle, and keeps a voxel off.
  EXPECT_EQ(cures[0].resolution, 256);
  EXPECT_NE(cures[0].sentence().find("a resolution of 256 or more"), std::string::npos) << cures[0].sentence();
}

TEST(Cures, NoFinerVoxelsAreAskedForWhereTheyAreFineEnough) {
  const std::vector<Cure> cures = cures_in(slotted(0.024, false), {"D12"});
  ASSERT_EQ(cures.size(), 1U);
  EXPECT_EQ(cures[0].obstacle, Obstacle::way);
  EXPECT_EQ(cures[0].resolution, 0);
}

TEST(Cures, AThinnerCutterIsNamedWhereAllAreTooThick) {
  const std::vector<Cure> cures = cures_in(slotted(0.0025, false), {"D20", "D3"});
  ASSERT_EQ(cures.size(), 1U);
  EXPECT_EQ(cures[0].obstacle, Obstacle::radius);
  EXPECT_DOUBLE_EQ(cures[0].diameter_m, 0.002);
}

TEST(Cures, WhereNoneComesThePartMustBeTurned) {
  const std::vector<Cure> cures = cures_in(slotted(0.008, true), {"D20", "D3"});
  ASSERT_EQ(cures.size(), 1U);
  EXPECT_EQ(cures[0].obstacle, Obstacle::side);
  EXPECT_EQ(cures[0].diameter_m, 0);
}

TEST(Cures, AreTheSameAtAnyNumberOfThreads) {
  const Mesh part = slotted(0.008, false);
  EXPECT_EQ(cures_in(part, {"D20", "D3"}, 1)[0].free_m, cures_in(part, {"D20", "D3"}, 4)[0].free_m);
}

TEST(Cures, NothingLeftNeedsNone) {
  const Mesh part = slotted(0.008, false);
  const Cell cell = parse_cell(milled::make_job("bust", n, {"D6"}).cell);
  const Grid grid{n, size_m / n, {-size_m / 2, -size_m / 2, 0.3}};
  const VoxelGrid voxels{VoxelSet(n), VoxelSet(n)};
  const std::vector<MillTool> tools;
  PartViews views(part, mill_directions().size());
  const Helpers helpers(1);
  const Watch watch;
  EXPECT_TRUE(
      find_cures({cell, grid, voxels, part, tools, {}, {}, {}}, VoxelSet(n), views, {0, helpers, watch}).empty());
}

}  // namespace
}  // namespace sculpt
