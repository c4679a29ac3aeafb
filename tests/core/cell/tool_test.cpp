#include "core/cell/tool.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/base/random.hpp"

namespace sculpt {
namespace {

std::string refusal(const ToolSpec& spec, double voxel_m, int resolution = 0) {
  try {
    make_tool(spec, voxel_m, resolution);
    return "accepted";
  } catch (const InputError& error) {
    return error.code() + ": " + error.what();
  }
}

TEST(Tool, FollowsTheVoxelOrStaysInMetres) {
  const Tool thin = make_tool({0.45, 0.4, true, 0.27}, 0.01);
  EXPECT_DOUBLE_EQ(thin.ball_radius_m, 0.0045);
  EXPECT_DOUBLE_EQ(thin.shank_radius_m, 0.004);
  EXPECT_DOUBLE_EQ(thin.stickout_m, 0.27);
  EXPECT_DOUBLE_EQ(make_tool({0.003, 0.002, false, 0.1}, 0.01).ball_radius_m, 0.003);
}

TEST(Tool, ThatDoesNotFitThroughAVoxelIsRefused) {
  EXPECT_TRUE(refusal({0.0049, 0.001, false, 0.1}, 0.01).starts_with("tool_too_large"));
  EXPECT_EQ(refusal({0.0048, 0.001, false, 0.1}, 0.01), "accepted");
  EXPECT_TRUE(refusal({0.002, 0.006, false, 0.1}, 0.01).starts_with("tool_too_large"));
  EXPECT_TRUE(refusal({0.6, 0.4, true, 0.1}, 0.01).starts_with("tool_too_large"));
}

TEST(Tool, RefusalNamesTheFinestResolutionThatIsPossible) {
  const ToolSpec six_mm{0.003, 0.003, false, 0.1};
  for (int n : {64, 128, 1024}) {
    const std::string said = refusal(six_mm, 0.2 / n, n);
    EXPECT_NE(said.find("at most 32 "), std::string::npos) << said;
  }
  EXPECT_EQ(refusal(six_mm, 0.2 / 32, 32), "accepted");
  EXPECT_EQ(refusal(six_mm, 0.2 / 64).find("at most"), std::string::npos) << "resolution not known";
  EXPECT_EQ(refusal({0.6, 0.4, true, 0.1}, 0.01, 64).find("resolution"), std::string::npos) << "it would be no cure";
}

TEST(Tool, HolderThatSwallowsTheBallIsRefused) {
  ToolSpec spec{0.003, 0.003, false, 0.1, {{0.0975, 0.02, 0.02}}};
  EXPECT_NE(refusal(spec, 0.01).find("not free"), std::string::npos);
  spec.holder[0].length_m = 0.096;
  EXPECT_EQ(refusal(spec, 0.01), "accepted");
}

/// Radius of the thickest part of the holder at `z_m` below the tool link's origin.
double true_radius(const ToolSpec& spec, double z_m) {
  double radius = 0, start = 0;
  for (const HolderSection& section : spec.holder) {
    const double t = (z_m - start) / section.length_m;
    if (t >= 0 && t <= 1) radius = std::max(radius, section.radius_m + t * (section.end_radius_m - section.radius_m));
    start += section.length_m;
  }
  return radius;
}

TEST(Tool, ShapesHoldTheHolderWithoutGapsAndLittleMore) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    ToolSpec spec{0.003, 0.003, false, 0.1};
    const int sections = 1 + static_cast<int>(random.next() % 4);
    double length = 0;
    for (int i = 0; i < sections; ++i) {
      const double radius = random.between(0.003, 0.02);
      spec.holder.push_back(
          {random.between(0.001, 0.02), radius, random.unit() < 0.3 ? radius : random.between(0.003, 0.02)});
      length += spec.holder.back().length_m;
    }
    double end = 0;
    for (const Shape& shape : holder_shapes(spec)) {
      const double begin = shape.pose.translation().z() - shape.length_m / 2;
      EXPECT_NEAR(begin, end, 1e-12);
      end = begin + shape.length_m;
      for (double t : {0.001, 0.25, 0.5, 0.75, 0.999}) {
        const double real = true_radius(spec, begin + t * shape.length_m);
        EXPECT_GE(shape.radius_m, real - 1e-12);
        EXPECT_LE(shape.radius_m, real + 0.0022) << "cones step by little more than 2 mm";
      }
    }
    EXPECT_NEAR(end, length, 1e-12);
  }
}

}  // namespace
}  // namespace sculpt
