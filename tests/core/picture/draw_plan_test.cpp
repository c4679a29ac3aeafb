#include "core/picture/draw_plan.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/core/cell/sample_robots.hpp"

namespace sculpt {
namespace {

constexpr int n = 16, pixels = 80;

/// A full grid in which the column of voxels at (2, 3) is cut down to the floor, and what is left over stands at (12,
/// 11).
StockMoment moment() {
  StockMoment moment;
  moment.header.grid = {n, 0.01, Vec3(-0.08, -0.08, 0)};
  moment.start = {VoxelSet(n, true), VoxelSet(n)};
  moment.standing = VoxelSet(n, true);
  moment.left = VoxelSet(n);
  moment.standing.erase({2, 3, 0}, {2, 3, n - 1});
  moment.left.insert({12, 11, n - 1});
  return moment;
}

struct Pixel {
  int red, green, blue;
};
Pixel at(const Picture& picture, int x, int y) {
  const std::size_t first = 3 * static_cast<std::size_t>(y * picture.width + x);
  return {picture.rgb[first], picture.rgb[first + 1], picture.rgb[first + 2]};
}
/// The pixel in the middle of a column of voxels, seen from above.
Pixel above(const Picture& picture, int i, int j) {
  const double pixels_a_voxel = pixels / 1.04 / n;
  return at(picture, static_cast<int>(pixels / 2.0 + pixels_a_voxel * (i + 0.5 - n / 2.0)),
            static_cast<int>(pixels / 2.0 - pixels_a_voxel * (j + 0.5 - n / 2.0)));
}

TEST(DrawPlan, FromAboveEachColumnIsWhereItStands) {
  const Picture picture = draw_plan(moment(), nullptr, {"top", pixels});
  ASSERT_EQ(picture.rgb.size(), 3u * pixels * pixels);
  const Pixel paper = at(picture, 0, 0), hole = above(picture, 2, 3), left = above(picture, 12, 11),
              raw = above(picture, 7, 7);
  EXPECT_EQ(hole.blue, paper.blue) << "one sees through";
  EXPECT_GT(left.red, 1.5 * left.green);
  EXPECT_LT(raw.red, 0.8 * paper.red);
  EXPECT_LT(std::abs(raw.red - raw.green), 30);
}

TEST(DrawPlan, IsTheSameEachTimeAndAnotherFromEachSide) {
  std::vector<std::vector<std::uint8_t>> seen;
  StockMoment corner_gone = moment();
  for (int k = 0; k < n; ++k) corner_gone.standing.erase({10, 0, k}, {n - 1, 0, k});
  corner_gone.standing.erase({0, 0, 15}, {0, 7, 15});
  corner_gone.standing.erase({14, 2, 15}, {14, 12, 15});
  for (const std::string& side : picture_sides()) {
    seen.push_back(draw_plan(corner_gone, nullptr, {side, pixels}).rgb);
    EXPECT_EQ(seen.back(), draw_plan(corner_gone, nullptr, {side, pixels}).rgb) << side;
    for (std::size_t other = 0; other + 1 < seen.size(); ++other)
      EXPECT_NE(seen[other], seen.back()) << side << " and " << picture_sides()[other];
  }
  EXPECT_THROW(draw_plan(corner_gone, nullptr, {"below", pixels}), std::invalid_argument);
}

TEST(DrawPlan, TheCellStandsAsTheJointsSay) {
  const Cell cell = shipped_cell("panda-turntable");
  const Chain chain = cell.chain();
  StockMoment here = moment();
  here.header.grid = cell.grid(n);
  here.header.joints = chain.names();
  here.header.tool = {0.002, 0.002, cell.tool.stickout_m};
  here.q = cell.home(chain);
  const Picture home = draw_plan(here, &cell, {"corner", pixels});
  here.q[1] += 0.4;
  EXPECT_NE(home.rgb, draw_plan(here, &cell, {"corner", pixels}).rgb);
  here.header.joints[1] = "elbow";
  try {
    draw_plan(here, &cell, {});
    FAIL() << "a joint that is not there";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), "cell_invalid");
    EXPECT_NE(std::string(error.what()).find("'elbow'"), std::string::npos);
  }
}

TEST(DrawPlan, TheMillingToolIsTheOneInTheSpindle) {
  const Cell cell = shipped_cell("studio");
  const Chain chain = cell.chain();
  StockMoment here = moment();
  here.header.grid = cell.grid(n);
  here.header.joints = chain.names();
  here.header.mill = MillHeader{{{"D80", 1, {CutterKind::ball, 0.04, 0.04, 0.2}, {}, 0.2, 0.01, 0.01, 0.1, {}, {}},
                                 {"D10", 2, {CutterKind::ball, 0.005, 0.005, 0.2}, {}, 0.2, 0.01, 0.01, 0.1, {}, {}}},
                                {{0, 0, 1}},
                                2e-5,
                                std::string(64, 'a')};
  here.q = cell.home(chain);
  const auto count_tool = [&] {
    const Picture picture = draw_plan(here, &cell, {"corner", 320});
    int yellow = 0;
    for (std::size_t at = 0; at < picture.rgb.size(); at += 3)
      yellow += picture.rgb[at] > 2 * picture.rgb[at + 2] && picture.rgb[at + 1] > 1.5 * picture.rgb[at + 2];
    return yellow;
  };
  const int thick = count_tool();
  here.tool = 1;
  const int thin = count_tool();
  EXPECT_GT(thin, 20);
  EXPECT_GT(thick, 4 * thin);
}

}  // namespace
}  // namespace sculpt
