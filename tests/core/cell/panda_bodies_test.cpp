// The shipped Panda's bodies against the collision meshes that ROS ships for the same arm.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>

#include "core/mesh/mesh_file.hpp"
#include "tests/core/cell/sample_robots.hpp"

namespace sculpt {
namespace {

constexpr double spacing_m = 0.002;
constexpr double tolerance_m = 0.001;
constexpr std::uint64_t memory_cap_bytes = 100'000'000;

/// Distance from the shape to a point of its link's frame; negative inside.
double signed_distance(const Shape& shape, const Vec3& point) {
  const Vec3 at = shape.pose.inverse() * point;
  Eigen::Vector2d beyond;  // cylinder: the wall and the ends
  switch (shape.kind) {
    case ShapeKind::sphere:
      return at.norm() - shape.radius_m;
    case ShapeKind::cylinder:
      beyond = {at.head<2>().norm() - shape.radius_m, std::abs(at.z()) - shape.length_m / 2};
      return std::min(beyond.maxCoeff(), 0.0) + beyond.cwiseMax(0).norm();
    case ShapeKind::box: {
      const Vec3 past = at.cwiseAbs() - shape.sides_m / 2;
      return std::min(past.maxCoeff(), 0.0) + past.cwiseMax(0).norm();
    }
    case ShapeKind::mesh:
      break;
  }
  ADD_FAILURE() << "the shipped Panda has no meshes";
  return std::numeric_limits<double>::infinity();
}

double signed_distance(const Link& link, const Vec3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const Shape& shape : link.shapes) least = std::min(least, signed_distance(shape, point));
  return least;
}

/// Points of every triangle, its corners and edges included, no farther apart than `spacing_m` along its edges.
std::vector<Vec3> sample_surface(const Mesh& mesh) {
  std::vector<Vec3> points;
  for (const auto& triangle : mesh.triangles) {
    const Vec3 &a = mesh.vertices[triangle[0]], &b = mesh.vertices[triangle[1]], &c = mesh.vertices[triangle[2]];
    const double longest = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
    const int steps =
        2 * std::max(1, static_cast<int>(std::ceil(longest / spacing_m / 2)));  // even: edge midpoints too
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) points.push_back(a + (b - a) * i / steps + (c - a) * j / steps);
  }
  return points;
}

TEST(PandaBodies, HoldTheCollisionMeshesOfTheRealArm) {
  const char* shared = std::getenv("SCULPT_SHARED_DATA");
  const std::filesystem::path meshes = std::filesystem::path(shared ? shared : SOURCE_DIR "/../shared/data") /
                                       "ros/moveit_resources_panda_description/meshes/collision";
  if (!std::filesystem::exists(meshes))
    GTEST_SKIP() << "no meshes of the Panda: set SCULPT_SHARED_DATA to the folder of shared data";

  const Cell cell = shipped_cell("panda-turntable");
  for (int number = 0; number <= 7; ++number) {
    const std::string name = "link" + std::to_string(number);
    SCOPED_TRACE(name);
    std::ifstream file(meshes / (name + ".stl"), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    const std::vector<Vec3> points = sample_surface(load_mesh(bytes, "stl", memory_cap_bytes, {}));
    const Link& link = cell.robot.links.at(static_cast<std::size_t>(cell.robot.find_link(name)));

    double excess = -std::numeric_limits<double>::infinity();
    Vec3 where = Vec3::Zero();
    for (const Vec3& point : points) {
      const double distance = signed_distance(link, point);
      if (distance > excess) {
        excess = distance;
        where = point;
      }
    }
    std::cout << name << ": " << points.size() << " points, worst excess " << excess * 1000 << " mm\n";
    EXPECT_LE(excess, tolerance_m) << "at " << where.transpose() << " in the link's frame";
    EXPECT_GT(excess, -0.01) << "bodies that hold the whole link this loosely are the wrong ones";
  }
}

}  // namespace
}  // namespace sculpt
