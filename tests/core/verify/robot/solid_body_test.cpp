#include "core/verify/robot/solid_body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

using Triangle = std::array<Vec3, 3>;

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

double distance_of_segments(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  // Convex in both parameters: the best of one for each of the other, by thirds.
  const auto at = [&](double t) { return distance_to_segment(a + t * (b - a), c, d); };
  double low = 0, high = 1;
  for (int step = 0; step < 60; ++step) {
    const double third = (high - low) / 3;
    if (at(low + third) < at(high - third))
      high -= third;
    else
      low += third;
  }
  return at((low + high) / 2);
}

double distance_to_triangle(const Vec3& p, const Triangle& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  const Vec3 foot = p - normal * normal.dot(p - t[0]);
  bool inside = true;
  for (std::size_t at = 0; at < 3; ++at)
    inside = inside && normal.dot((t[(at + 1) % 3] - t[at]).cross(foot - t[at])) >= 0;
  double nearest = inside ? (p - foot).norm() : 1e9;
  for (std::size_t at = 0; at < 3; ++at) nearest = std::min(nearest, distance_to_segment(p, t[at], t[(at + 1) % 3]));
  return nearest;
}

bool cuts(const Vec3& a, const Vec3& b, const Triangle& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double at_a = normal.dot(a - t[0]), at_b = normal.dot(b - t[0]);
  if (at_a * at_b > 0) return false;
  const Vec3 point = a + at_a / (at_a - at_b) * (b - a);
  for (std::size_t at = 0; at < 3; ++at)
    if (normal.dot((t[(at + 1) % 3] - t[at]).cross(point - t[at])) < 0) return false;
  return true;
}

double distance(const Triangle& one, const Triangle& other) {
  double nearest = 1e9;
  for (std::size_t a = 0; a < 3; ++a) {
    if (cuts(one[a], one[(a + 1) % 3], other) || cuts(other[a], other[(a + 1) % 3], one)) return 0;
    nearest = std::min({nearest, distance_to_triangle(one[a], other), distance_to_triangle(other[a], one)});
    for (std::size_t b = 0; b < 3; ++b)
      nearest = std::min(nearest, distance_of_segments(one[a], one[(a + 1) % 3], other[b], other[(b + 1) % 3]));
  }
  return nearest;
}

TEST(SolidBody, MeshesAreWithinWhatTheirTrianglesAre) {
  int apart = 0, meeting = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const auto place = [&](double size) {
      return Vec3(random.between(-size, size), random.between(-size, size), random.between(-size, size));
    };
    const auto make = [&](std::vector<Triangle>& triangles) {
      SolidMesh mesh;
      mesh.beginModel(30);
      for (int triangle = 0; triangle < 30; ++triangle) {
        const Vec3 middle = place(200);
        triangles.push_back({middle + place(60), middle + place(60), middle + place(60)});
        mesh.addTriangle(triangles.back()[0], triangles.back()[1], triangles.back()[2]);
      }
      mesh.endModel();
      return mesh;
    };
    const auto pose = [&](double far) {
      Frame frame = Frame::Identity();
      frame.translation() = place(far);
      frame.linear() = Eigen::Quaterniond(Eigen::Vector4d(random.between(-1, 1), random.between(-1, 1),
                                                          random.between(-1, 1), random.between(-1, 1)))
                           .normalized()
                           .toRotationMatrix();
      return frame;
    };
    std::vector<Triangle> ones, others;
    const SolidMesh one = make(ones), other = make(others);
    const Frame pose_one = pose(100), pose_other = pose(450);
    double nearest = 1e9;
    for (const Triangle& a : ones)
      for (const Triangle& b : others)
        nearest = std::min(nearest, distance({pose_one * a[0], pose_one * a[1], pose_one * a[2]},
                                             {pose_other * b[0], pose_other * b[1], pose_other * b[2]}));
    const auto within = [&](double reach) { return meshes_within(one, pose_one, other, pose_other, reach); };
    EXPECT_TRUE(within(nearest + 1e-4));
    EXPECT_TRUE(within(2 * nearest + 1));
    if (nearest > 1e-3) {
      ++apart;
      EXPECT_FALSE(within(nearest - 1e-4));
      EXPECT_FALSE(within(nearest / 2));
    } else {
      ++meeting;
    }
  }
  EXPECT_GT(apart, 15);
  EXPECT_GT(meeting, 5);
}

}  // namespace
}  // namespace sculpt
