// A plate with the features that milling fails at, each with the figure that geometry gives for it.
//
//   from above, 50 x 50 mm, 12 mm deep features in a plate of 40 mm:
//
//   +--------------------+
//   |  bowl    | groove  |   bowl: half a ball of 10 mm; groove: 120 degrees, along y
//   |  (    )  |  \/     |
//   |----------+---------|
//   | pocket|pocket slot |   pockets with a wall of 2 mm between them; slot: 4 mm wide, thinner than the cutter
//   +--------------------+
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>

#include "core/plan/intake.hpp"
#include "core/verify/mill/machined_surface.hpp"
#include "tests/core/mill/milled_plan.hpp"

namespace sculpt {
namespace {

namespace fs = std::filesystem;

constexpr double side_mm = 50, top_mm = 40, cells_a_mm = 2, radius_mm = 3, tolerance_mm = 0.3;
constexpr double bowl_x = 13, bowl_y = 36, bowl_mm = 10, groove_x = 37, groove_depth_mm = 6;
constexpr double pocket_depth_mm = 6, slot_x = 41;

/// How high the plate is (mm).
double height(double x, double y) {
  if (const double off = std::hypot(x - bowl_x, y - bowl_y); off < bowl_mm)
    return top_mm - std::sqrt(bowl_mm * bowl_mm - off * off);
  const double flank = std::tan(std::numbers::pi / 3);
  if (y > 26 && y < 48)
    if (const double off = std::abs(x - groove_x); off < groove_depth_mm * flank)
      return top_mm - groove_depth_mm + off / flank;
  const bool in_pockets = y > 4 && y < 20 && ((x > 3 && x < 15) || (x > 17 && x < 29));
  const bool in_slot = y > 4 && y < 20 && std::abs(x - slot_x) < 2;
  return in_pockets || in_slot ? top_mm - pocket_depth_mm : top_mm;
}

/// As a binary STL, mm: the top over a lattice, sides and bottom plain.
std::string plate() {
  std::string triangles;
  std::uint32_t count = 0;
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    std::array<float, 12> numbers{};
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t axis = 0; axis < 3; ++axis)
        numbers[3 + 3 * corner + axis] = static_cast<float>((corner == 0   ? a
                                                             : corner == 1 ? b
                                                                           : c)[static_cast<int>(axis)]);
    triangles.append(reinterpret_cast<const char*>(numbers.data()), sizeof(numbers));
    triangles.append(2, '\0');
    ++count;
  };
  const int n = static_cast<int>(side_mm * cells_a_mm);
  const auto top = [&](int i, int j) {
    const double x = i / cells_a_mm, y = j / cells_a_mm;
    return Vec3(x, y, height(x, y));
  };
  const auto floor = [&](int i, int j) { return Vec3(i / cells_a_mm, j / cells_a_mm, 0); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      add(top(i, j), top(i + 1, j), top(i + 1, j + 1));
      add(top(i, j), top(i + 1, j + 1), top(i, j + 1));
      add(floor(i, j), floor(i + 1, j + 1), floor(i + 1, j));
      add(floor(i, j), floor(i, j + 1), floor(i + 1, j + 1));
    }
  for (int at = 0; at < n; ++at)
    for (const auto& [a, b] : {std::pair{std::array{at, 0}, std::array{at + 1, 0}},
                               {std::array{n, at}, {n, at + 1}},
                               {std::array{at + 1, n}, {at, n}},
                               {std::array{0, at + 1}, {0, at}}}) {
      add(floor(a[0], a[1]), floor(b[0], b[1]), top(b[0], b[1]));
      add(floor(a[0], a[1]), top(b[0], b[1]), top(a[0], a[1]));
    }
  std::string stl(80, ' ');
  stl.append(reinterpret_cast<const char*>(&count), sizeof(count));
  return stl + triangles;
}

struct Milled {
  Job job;
  JobResult result;
  MachinedSurface surface;
};
const Milled& milled() {
  static const Milled milled = [] {
    Milled made{milled::make_job("bust", 32, {"D6"}), {}, {}};
    made.job.mesh = {plate(), "stl", "plate.stl"};
    made.job.mill->tolerance_m = tolerance_mm / 1000;
    made.job.threads = 2;
    const fs::path file = milled::scratch("plate.ndjson");
    made.result = run_job(made.job, file, {});
    const Grid grid = parse_cell(made.job.cell).grid(made.job.resolution);
    JobShapes shapes(made.job);
    Mesh part = shapes.place_part(grid, {});
    std::ifstream plan(file, std::ios::binary);
    made.surface = machined_surface(plan, std::move(part), std::move(shapes).take_voxels(grid, {}), grid, {});
    fs::remove(file);
    return made;
  }();
  return milled;
}

/// Where a vertex was moved to, and how far (mm, from the block's corner).
struct Moved {
  double x, y, z, excess;
};
/// What stands above those vertices that are meant, at the top of the plate.
std::vector<double> excess_at(const std::function<bool(const Moved&)>& is_meant) {
  const MachinedSurface& surface = milled().surface;
  const Vec3 corner = parse_cell(milled().job.cell).grid(32).origin_m;
  std::vector<double> found;
  for (std::size_t vertex = 0; vertex < surface.excess_m.size(); ++vertex) {
    const Vec3 at = 1000 * (surface.mesh.vertices[vertex] - corner);
    const Moved moved{at.x(), at.y(), at.z(), 1000 * surface.excess_m[vertex]};
    if (moved.z > top_mm / 2 && is_meant(moved)) found.push_back(moved.excess);
  }
  std::ranges::sort(found);
  return found;
}

double share_within(const std::vector<double>& excess_mm, double most_mm) {
  return static_cast<double>(std::ranges::upper_bound(excess_mm, most_mm) - excess_mm.begin()) /
         static_cast<double>(excess_mm.size());
}

TEST(Plate, IsCleanAndNothingIsCutTooDeep) {
  const Report& report = milled().result.report;
  for (const std::string& finding : report.findings) std::cout << finding << "\n";
  EXPECT_TRUE(report.verify.clean);
  ASSERT_TRUE(report.surface);
  EXPECT_EQ(report.surface->gouged_points, 0u);
}

TEST(Plate, BowlAndTopAreWithinTheTolerance) {
  const auto bowl = excess_at(
      [](const Moved& at) { return std::hypot(at.x - bowl_x, at.y - bowl_y) < bowl_mm - 1 && at.z < top_mm - 0.5; });
  ASSERT_GT(bowl.size(), 300u);
  EXPECT_GT(share_within(bowl, tolerance_mm), 0.98) << bowl.back();
  const auto top = excess_at([](const Moved& at) {
    return at.z > top_mm - 0.01 && at.z < top_mm + 5 && height(at.x, at.y) == top_mm && at.x > 1 && at.y > 1 &&
           at.x < 49 && at.y < 49;
  });
  ASSERT_GT(top.size(), 1000u);
  EXPECT_GT(share_within(top, tolerance_mm), 0.98) << top.back();
}

/// A ball between two flanks at 60 degrees to the axis leaves r / sin 60 - r above the crease.
TEST(Plate, TheCreaseHasWhatTheBallLeaves) {
  const auto crease = excess_at([](const Moved& at) {
    return std::abs(at.x - groove_x) < 0.01 && at.y > 30 && at.y < 44 && at.z < top_mm - groove_depth_mm + 2;
  });
  ASSERT_GT(crease.size(), 20u);
  const double sine = std::sin(std::numbers::pi / 3), least = radius_mm / sine - radius_mm;
  EXPECT_GT(crease.front(), least - 0.002);
  EXPECT_LT(crease[crease.size() / 2], least + tolerance_mm / sine);
}

TEST(Plate, TheWallBetweenPocketsStands) {
  const auto wall_top = excess_at(
      [](const Moved& at) { return at.x > 15.1 && at.x < 16.9 && at.y > 6 && at.y < 18 && at.z > top_mm - 0.1; });
  ASSERT_GT(wall_top.size(), 20u);
  EXPECT_GT(share_within(wall_top, tolerance_mm), 0.9) << wall_top.back();
  const double floor_mm = top_mm - pocket_depth_mm;
  const auto floors = excess_at([&](const Moved& at) {
    const bool in_middle = at.y > 8 && at.y < 16 && ((at.x > 7 && at.x < 11) || (at.x > 21 && at.x < 25));
    return in_middle && at.z >= floor_mm && at.z < floor_mm + 1.2;
  });
  ASSERT_GT(floors.size(), 50u);
  EXPECT_GT(share_within(floors, tolerance_mm), 0.95) << floors.back();
}

TEST(Plate, TheSlotThatIsTooThinIsLeftAndTheReportNamesTheCutter) {
  const double sunk_mm = radius_mm - std::sqrt(radius_mm * radius_mm - 2 * 2), left_mm = pocket_depth_mm - sunk_mm,
               voxel_mm = side_mm / 32;
  const auto slot = excess_at([&](const Moved& at) {
    const bool from_floor = std::abs(at.z - at.excess - (top_mm - pocket_depth_mm)) < 0.01;
    return from_floor && std::abs(at.x - slot_x) < 0.6 && at.y > 8 && at.y < 16;
  });
  ASSERT_GT(slot.size(), 20u);
  EXPECT_GT(slot.front(), left_mm - 0.002) << "the ball does not go in";
  EXPECT_LT(slot.back(), left_mm + tolerance_mm + voxel_mm) << "but as deep as it can";
  const auto& cures = milled().result.report.cures;
  EXPECT_TRUE(std::ranges::any_of(
      cures, [](const Cure& cure) { return cure.obstacle == Obstacle::radius && cure.diameter_m < 2e-3 * radius_mm; }));
}

}  // namespace
}  // namespace sculpt
