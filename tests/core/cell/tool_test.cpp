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

TEST(Tool, ProfileOfAToolWithoutHolderIsItsShankAndOfABareBallNothing) {
  const ToolSpec thin{0.45, 0.4, true, 0.27};
  const auto profile = tool_profile(thin, make_tool(thin, 0.01));
  ASSERT_EQ(profile.size(), 1u);
  EXPECT_EQ(profile[0].from_m, 0);
  EXPECT_EQ(profile[0].to_m, 0.27);
  EXPECT_DOUBLE_EQ(profile[0].radius_m, 0.004);
  const ToolSpec ball{0.45, 0, true, 0};
  EXPECT_TRUE(tool_profile(ball, make_tool(ball, 0.01)).empty());
}

/// Radius of the thickest thing that the tool really has at `height_m` above the ball's centre.
double true_radius(const ToolSpec& spec, double height_m) {
  double radius = spec.shank_radius, start = spec.stickout_m;
  for (const HolderSection& section : spec.holder) {
    const double t = (start - height_m) / section.length_m;
    if (t >= 0 && t <= 1) radius = std::max(radius, section.radius_m + t * (section.end_radius_m - section.radius_m));
    start -= section.length_m;
  }
  return radius;
}

TEST(Tool, ProfileAndShapesHoldTheHolderWithoutGapsAndLittleMore) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    ToolSpec spec{0.003, random.between(0.001, 0.003), false, 0.1};
    const int sections = 1 + static_cast<int>(random.next() % 4);
    for (int i = 0; i < sections; ++i) {
      const double radius = random.between(0.003, 0.02);
      spec.holder.push_back(
          {random.between(0.001, 0.02), radius, random.unit() < 0.3 ? radius : random.between(0.003, 0.02)});
    }
    const Tool tool = make_tool(spec, 0.01);
    const auto profile = tool_profile(spec, tool);
    const auto shapes = holder_shapes(spec);
    ASSERT_EQ(profile.size(), shapes.size() + 1);
    EXPECT_EQ(profile.front().from_m, 0);
    EXPECT_NEAR(profile.back().to_m, spec.stickout_m, 1e-12);
    for (std::size_t i = 0; i < profile.size(); ++i) {
      const ToolSection& section = profile[i];
      if (i > 0) {
        EXPECT_NEAR(section.from_m, profile[i - 1].to_m, 1e-12);
        const Shape& shape = shapes[shapes.size() - i];
        EXPECT_DOUBLE_EQ(shape.radius_m, section.radius_m);
        EXPECT_NEAR(spec.stickout_m - shape.pose.translation().z() - shape.length_m / 2, section.from_m, 1e-12);
        EXPECT_NEAR(spec.stickout_m - shape.pose.translation().z() + shape.length_m / 2, section.to_m, 1e-12);
      }
      for (double t : {0.001, 0.25, 0.5, 0.75, 0.999}) {
        const double real = true_radius(spec, section.from_m + t * (section.to_m - section.from_m));
        EXPECT_GE(section.radius_m, real - 1e-12);
        EXPECT_LE(section.radius_m, real + 0.0022) << "cones step by little more than 2 mm";
      }
    }
  }
}

}  // namespace
}  // namespace sculpt
