#include "core/mill/finish/free_ball.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

constexpr double radius = 0.3;

/// Two walls of 4 x 4 that meet in the y axis at `angle`, open upwards.
Mesh make_groove(double angle) {
  Mesh mesh;
  for (const int side : {-1, 1}) {
    const Vec3 up(4 * side * std::sin(angle / 2), 0, 4 * std::cos(angle / 2));
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const double y : {-2.0, 2.0})
      for (const double share : {0.0, 1.0}) mesh.vertices.push_back(Vec3(0, y, 0) + share * up);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first + 1, first + 3, first + 2});
  }
  return mesh;
}

double distance_by_samples(const Mesh& mesh, const Vec3& from) {
  constexpr int along = 60;
  double nearest = 1e9;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i <= along; ++i)
      for (int j = 0; i + j <= along; ++j) {
        const double x = static_cast<double>(i) / along, y = static_cast<double>(j) / along;
        nearest = std::min(
            nearest,
            ((1 - x - y) * mesh.vertices[t[0]] + x * mesh.vertices[t[1]] + y * mesh.vertices[t[2]] - from).norm());
      }
  return nearest;
}

TEST(FreeBall, ComesToRestBetweenTheWallsOfAGroove) {
  for (const double degrees : {150.0, 90.0, 60.0, 40.0}) {
    SCOPED_TRACE(degrees);
    const double angle = degrees * std::numbers::pi / 180;
    const FreeBall ball(make_groove(angle));
    // As if it rested on a point of one wall that is so near to the crease that the other wall is in its way.
    const Vec3 normal(-std::cos(angle / 2), 0, std::sin(angle / 2)), along(std::sin(angle / 2), 0, std::cos(angle / 2));
    const double touch = radius / std::tan(angle / 2);
    const auto middle = ball.push_out(0.9 * touch * along + radius * normal, radius);
    ASSERT_TRUE(middle);
    EXPECT_NEAR(middle->x(), 0, 0.03 * radius);
    EXPECT_NEAR(middle->z(), radius / std::sin(angle / 2), 0.03 * radius);
  }
}

TEST(FreeBall, StaysWhereNothingIsInItsWayAndGivesUpWhereThereIsNoRoom) {
  const Mesh groove = make_groove(std::numbers::pi / 2);
  const FreeBall ball(groove);
  EXPECT_EQ(ball.push_out({0.1, 0.2, 1}, radius), Vec3(0.1, 0.2, 1));
  EXPECT_FALSE(ball.push_out({0, 0, 0}, radius));
  Mesh slot;
  for (const double x : {-0.2, 0.2}) {
    const auto first = static_cast<std::uint32_t>(slot.vertices.size());
    for (const double y : {-50.0, 50.0})
      for (const double z : {-50.0, 50.0}) slot.vertices.emplace_back(x, y, z);
    slot.triangles.push_back({first, first + 1, first + 2});
    slot.triangles.push_back({first + 1, first + 3, first + 2});
  }
  EXPECT_FALSE(FreeBall(slot).push_out({0.05, 0, 0}, radius));
}

TEST(FreeBall, IsClearWhereItEndsAndNotFarFromWhereItBegan) {
  int ended = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Mesh mesh;
    for (std::uint32_t corner = 0; corner < 24; ++corner)
      mesh.vertices.emplace_back(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    for (std::uint32_t first = 0; first < 24; first += 3) mesh.triangles.push_back({first, first + 1, first + 2});
    const FreeBall ball(mesh);
    for (int trial = 0; trial < 50; ++trial) {
      const Vec3 start(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
      const auto middle = ball.push_out(start, radius);
      if (!middle) continue;
      ++ended;
      EXPECT_GE(distance_by_samples(mesh, *middle), radius - 1e-9);
      if (distance_by_samples(mesh, start) >= radius) {
        EXPECT_LT((*middle - start).norm(), 0.05);  // samples see a little less
      }
    }
  }
  EXPECT_GT(ended, 300);
}

}  // namespace
}  // namespace sculpt
