#include "core/doctor/draw_cell.hpp"

#include <gtest/gtest.h>

#include "tests/core/cell/sample_robots.hpp"

namespace sculpt {
namespace {

/// Pixels that are much more red than anything else.
int count_red(const Picture& picture) {
  int red = 0;
  for (std::size_t at = 0; at + 2 < picture.rgb.size(); at += 3)
    red += picture.rgb[at] > 90 && picture.rgb[at] > 2.5 * picture.rgb[at + 1] &&
           picture.rgb[at] > 2.5 * picture.rgb[at + 2];
  return red;
}

Picture draw(const std::vector<NearBodies>& blocking) {
  const Cell cell = shipped_cell("panda-turntable");
  return draw_cell(cell, cell.home(cell.chain()), blocking, 120);
}

TEST(DrawCell, IsThreeSquaresSideBySide) {
  const Picture picture = draw({});
  EXPECT_EQ(picture.width, 360);
  EXPECT_EQ(picture.height, 120);
  EXPECT_EQ(picture.rgb.size(), 3u * 360 * 120);
}

TEST(DrawCell, WhatBlocksIsRed) {
  const Cell cell = shipped_cell("panda-turntable");
  const int axis = count_red(draw({}));  // x is red too
  EXPECT_GT(count_red(draw({{cell.robot.find_link("link4"), cell.robot.find_link("link6"), 0, true}})), axis + 100);
  EXPECT_GT(count_red(draw({{cell.robot.find_link("link1"), NearBodies::stock, 0, true}})), axis + 100);
}

TEST(DrawCell, TheNearerOfTwoFacetsIsSeen) {
  const Colour green{0, 200, 0}, blue{0, 0, 200};
  const auto square = [](double depth, const Colour& colour) {
    return Facet{{Vec3(-3, depth, -3), Vec3(3, depth, -3), Vec3(0, depth, 3)}, colour, {}};
  };
  for (const bool green_first : {true, false}) {
    Canvas canvas(20, 20, {Vec3::UnitX(), Vec3::UnitZ(), Vec3::Zero(), 1, 0});  // seen from y < 0
    canvas.draw(green_first ? square(-1, green) : square(1, blue));
    canvas.draw(green_first ? square(1, blue) : square(-1, green));
    const Picture picture = canvas.finish();
    const std::size_t middle = 3 * (10 * 20 + 10);
    EXPECT_GT(picture.rgb[middle + 1], picture.rgb[middle + 2]) << "green is nearer";
  }
}

}  // namespace
}  // namespace sculpt
