#include "core/collision/clearance.hpp"

#include <gtest/gtest.h>

#include "tests/core/cell/sample_robots.hpp"

namespace sculpt {
namespace {

/// The farthest that the piece reaches along a direction (m, frame of `pose`); cylinders and boxes by their corners.
double reach_along(const Piece& piece, const Frame& pose, const Vec3& direction) {
  const Frame at = pose * piece.shape.pose;
  if (piece.shape.kind == ShapeKind::sphere) return direction.dot(at.translation()) + piece.shape.radius_m;
  const Vec3 local = at.linear().transpose() * direction;
  if (piece.shape.kind == ShapeKind::box)
    return direction.dot(at.translation()) + local.cwiseAbs().dot(piece.shape.sides_m) / 2;
  return direction.dot(at.translation()) + std::abs(local.z()) * piece.shape.length_m / 2 +
         local.head<2>().norm() * piece.shape.radius_m;
}

TEST(Clearance, APlaneOfEverySeparationLiesBetweenTheTwo) {
  const Cell cell = shipped_cell("panda-turntable");
  const Chain chain = cell.chain();
  const std::vector<Body> bodies = make_bodies(cell, make_tool(cell.tool, 0.01));
  int planes = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    std::vector<Frame> at;
    chain.link_poses(random_configuration(chain, random), at);
    for (const Body& a : bodies)
      for (const Body& b : bodies) {
        if (a.link == b.link) continue;
        SCOPED_TRACE(::testing::Message() << "seed " << seed << ", links " << a.link << " and " << b.link);
        const Frame &pose_a = at[static_cast<std::size_t>(a.link)], &pose_b = at[static_cast<std::size_t>(b.link)];
        const auto found = separations(a, pose_a, b, pose_b, 0.2);
        if (!found) continue;
        for (const Separation& one : *found) {
          ++planes;
          const double capsule =
              std::min(one.normal.dot(one.capsule.core.a), one.normal.dot(one.capsule.core.b)) - one.capsule.radius_m;
          const bool behind = std::any_of(b.pieces.begin(), b.pieces.end(), [&](const Piece& piece) {
            return reach_along(piece, pose_b, one.normal) <= capsule - one.gap_m + 1e-9;
          });
          ASSERT_TRUE(behind);
        }
        // What is not among them is farther off.
        if (found->empty()) {
          ASSERT_FALSE(near_body(a, pose_a, b, pose_b, 0.199));
        }
      }
  }
  EXPECT_GT(planes, 1000);
}

TEST(Clearance, NothingIsSaidOfWhatTouches) {
  const Cell cell = shipped_cell("panda-turntable");
  const std::vector<Body> bodies = make_bodies(cell, make_tool(cell.tool, 0.01));
  EXPECT_FALSE(separations(bodies[0], Frame::Identity(), bodies[0], Frame::Identity(), 0.1));
}

}  // namespace
}  // namespace sculpt
