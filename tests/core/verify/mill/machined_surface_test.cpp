#include "core/verify/mill/machined_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/trajectory/milling/quanta_point.hpp"
#include "core/trajectory/writer.hpp"
#include "tests/core/mesh/box.hpp"

namespace sculpt {
namespace {

constexpr int n = 16;
constexpr double size_m = 0.064, voxel_m = size_m / n, part_m = 0.032, radius_m = 0.01;
const Grid grid{n, voxel_m, Vec3(-0.01, 0.02, 0.5)};

/// The lower half of the block, as a box.
Mesh lower_half() {
  std::array<Vec3, 8> corners;
  for (int corner = 0; corner < 8; ++corner)
    corners[static_cast<std::size_t>(corner)] =
        grid.origin_m + Vec3(size_m * (corner & 1), size_m * (corner >> 1 & 1), part_m * (corner >> 2));
  return box_between(corners);
}

VoxelGrid halves() {
  VoxelGrid voxels{VoxelSet(n, true), VoxelSet(n)};
  for_each_voxel(voxels.stock, [&](Voxel v) {
    if (v.k < n / 2) voxels.keep.insert(v);
  });
  return voxels;
}

/// A ball goes along x over the middle of the part, `above_m` it at its lowest.
std::string one_pass(double above_m, double stray_m) {
  TrajectoryHeader header;
  header.joints = {"x"};
  header.home = Configuration::Zero(1);
  header.grid = grid;
  header.tolerance_m = 1e-4;
  header.cell = "none";
  header.search = "mill";
  const MillTool ball{
      "D20", 1, {CutterKind::ball, radius_m, radius_m, 0.06}, {{0.06, 0.01, 0.01}}, 0.12, 0.01, 0.01, 0.1, {}, {}};
  header.mill = MillHeader{{ball}, {{0, 0, 1}}, stray_m, std::string(64, 'a')};
  std::ostringstream out;
  TrajectoryWriter writer(out, header);
  const auto to = [&](double x, bool cut) {
    Keyframe keyframe{Configuration::Zero(1), cut, {}, {}, MillStep{}};
    keyframe.mill->tip = quanta_of(grid.origin_m + Vec3(x, size_m / 2, part_m + above_m));
    keyframe.mill->direction = 0;
    writer.add(keyframe);
  };
  to(-0.02, false);
  for (int edge = 0; edge <= 10; ++edge) to(-0.02 + 0.0104 * edge, true);
  writer.finish();
  return out.str();
}

/// The ordered surface is the plane z = part_m; on it the ball leaves a cylinder's valley.
TEST(MachinedSurface, OfOnePassIsTheBallsValley) {
  for (const auto& [above_m, stray_m] : {std::pair{0.0, 0.0}, {5e-5, 0.0}, {2e-4, 3e-5}}) {
    std::istringstream plan(one_pass(above_m, stray_m));
    const MachinedSurface surface = machined_surface(plan, lower_half(), halves(), grid, {});
    ASSERT_EQ(surface.mesh.vertices.size(), surface.excess_m.size());
    ASSERT_GT(surface.mesh.triangles.size(), 10'000u);
    std::size_t in_valley = 0, beside = 0;
    for (std::size_t vertex = 0; vertex < surface.excess_m.size(); ++vertex) {
      const Vec3 at = surface.mesh.vertices[vertex] - grid.origin_m;
      const double off = std::abs(at.y() - size_m / 2), excess_m = surface.excess_m[vertex], small = radius_m - stray_m;
      EXPECT_GE(excess_m, 0);
      const double to_side = std::min({at.x(), at.y(), size_m - at.x(), size_m - at.y()});
      if (at.z() < part_m - 1e-9 || to_side < 1e-5) continue;
      const double valley_m = small > off ? above_m + radius_m - std::sqrt(small * small - off * off) : 1;
      EXPECT_NEAR(at.z(), part_m + excess_m, 1e-12) << "moved outwards";
      if (valley_m < 0.9e-3) {
        EXPECT_NEAR(excess_m, valley_m, 2e-7) << off;
        ++in_valley;
      } else if (off > radius_m + 2 * voxel_m) {
        EXPECT_GT(excess_m, size_m - part_m - voxel_m) << "nothing was cut above it";
        ++beside;
      }
    }
    EXPECT_GT(in_valley, 1000u);
    EXPECT_GT(beside, 1000u);
  }
}

TEST(MachinedSurface, OfAPartThatIsInsideOutIsTheSame) {
  Mesh turned = lower_half();
  for (auto& triangle : turned.triangles) std::swap(triangle[0], triangle[1]);
  std::istringstream plan(one_pass(1e-4, 0)), again(one_pass(1e-4, 0));
  const MachinedSurface one = machined_surface(plan, lower_half(), halves(), grid, {}),
                        other = machined_surface(again, turned, halves(), grid, {});
  double high = 0, high_other = 0;
  for (const Vec3& vertex : one.mesh.vertices) high += vertex.z();
  for (const Vec3& vertex : other.mesh.vertices) high_other += vertex.z();
  EXPECT_EQ(one.mesh.vertices.size(), other.mesh.vertices.size());
  EXPECT_NEAR(high, high_other, 1e-3 * high);
}

TEST(MachinedSurface, LeavesOutWhatIsInsideOfTheTarget) {
  Mesh part = lower_half();
  const auto first = static_cast<std::uint32_t>(part.vertices.size());
  const Vec3 middle = grid.origin_m + Vec3(size_m / 2, size_m / 2, part_m / 2);
  for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(2e-3, 0, 0), Vec3(0, 2e-3, 0), Vec3(0, 0, 2e-3)})
    part.vertices.push_back(middle + corner);
  for (const auto& t : {std::array<std::uint32_t, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
    part.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  std::istringstream plan(one_pass(0, 0)), again(one_pass(0, 0));
  EXPECT_EQ(machined_surface(plan, part, halves(), grid, {}).mesh.triangles,
            machined_surface(again, lower_half(), halves(), grid, {}).mesh.triangles);
}

TEST(MachinedSurface, CanBeStopped) {
  std::stop_source stop;
  stop.request_stop();
  std::istringstream plan(one_pass(0, 0));
  EXPECT_THROW(machined_surface(plan, lower_half(), halves(), grid, {stop.get_token(), {}}), Cancelled);
}

}  // namespace
}  // namespace sculpt
