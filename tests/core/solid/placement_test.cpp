#include "core/solid/placement.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/core/material/shapes.hpp"

namespace sculpt {
namespace {

const Grid grid{64, 0.01, Vec3(-0.32, -0.32, 0.5)};  // 0.64 m an edge

Eigen::AlignedBox3d bounds(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& vertex : mesh.vertices) box.extend(vertex);
  return box;
}

Eigen::AlignedBox3d placed(const Vec3& size, const Placement& placement) {
  return bounds(place_mesh(shapes::box(Vec3(7, 8, 9), Vec3(7, 8, 9) + size), placement, grid));
}

std::string refusal(const Placement& placement, const std::string& code) {
  const auto work = [&] { placed(Vec3(1, 2, 4), placement); };
  EXPECT_EQ(shapes::error_code(work), code);
  return shapes::error_sentence(work);
}

TEST(Placement, ByDefaultTheLargestSideFillsTheStockCentredOnTheFloor) {
  const auto box = placed(Vec3(1, 2, 4), {});
  EXPECT_TRUE(box.min().isApprox(Vec3(-0.08, -0.16, 0.5), 1e-12)) << box.min().transpose();
  EXPECT_TRUE(box.max().isApprox(Vec3(0.08, 0.16, 1.14), 1e-12)) << box.max().transpose();
}

TEST(Placement, TheMarginIsLeftAtTheSidesAndAtTheTop) {
  Placement placement;
  placement.margin_m = 0.1;
  EXPECT_NEAR(placed(Vec3(1, 1, 10), placement).max().z(), 0.5 + 0.54, 1e-12);
  EXPECT_NEAR(placed(Vec3(1, 1, 10), placement).min().z(), 0.5, 1e-12);
  EXPECT_NEAR(placed(Vec3(10, 1, 1), placement).min().x(), -0.22, 1e-12);
  EXPECT_NEAR(placed(Vec3(1, 1, 1), placement).max().y(), 0.22, 1e-12);
}

TEST(Placement, RotationIsRollPitchYawAboutFixedAxesBeforeFitting) {
  Placement placement;
  placement.rotation_rad = Vec3(EIGEN_PI / 2, 0, EIGEN_PI / 2);  // y -> z, then x -> y
  const Vec3 size = placed(Vec3(1, 4, 2), placement).sizes();
  EXPECT_TRUE(size.isApprox(Vec3(0.32, 0.16, 0.64), 1e-9)) << size.transpose();
}

TEST(Placement, ScaleAndOffsetAreTakenAsGiven) {
  Placement placement;
  placement.scale_m = 0.05;
  placement.offset_m = Vec3(0.1, -0.1, 0.2);
  const auto box = placed(Vec3(1, 2, 4), placement);
  EXPECT_TRUE(box.center().isApprox(Vec3(0.1, -0.1, 0.8), 1e-12)) << box.center().transpose();
  EXPECT_TRUE(box.sizes().isApprox(Vec3(0.05, 0.1, 0.2), 1e-12));
}

TEST(Placement, WhatWouldStandOutsideIsRefusedWithTheLengthAndTheOption) {
  Placement large;
  large.scale_m = 1;
  EXPECT_NE(refusal(large, "target_outside_stock").find("lower scale_m"), std::string::npos);
  Placement moved;
  moved.offset_m = Vec3(0, 0, -0.01);
  const std::string sentence = refusal(moved, "target_outside_stock");
  EXPECT_NE(sentence.find("0.01 m at the low end of z: change offset_m"), std::string::npos) << sentence;
}

TEST(Placement, NumbersThatMakeNoSenseAreRefused) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (double scale : {0.0, -1.0, nan, infinity}) {
    Placement placement;
    placement.scale_m = scale;
    EXPECT_NE(refusal(placement, "placement_invalid").find("scale_m"), std::string::npos);
  }
  for (double margin : {-0.01, 0.32, nan}) {
    Placement placement;
    placement.margin_m = margin;
    EXPECT_NE(refusal(placement, "placement_invalid").find("margin_m"), std::string::npos);
  }
  Placement turned, moved;
  turned.rotation_rad.x() = nan;
  moved.offset_m.y() = infinity;
  refusal(turned, "placement_invalid");
  refusal(moved, "placement_invalid");
}

}  // namespace
}  // namespace sculpt
