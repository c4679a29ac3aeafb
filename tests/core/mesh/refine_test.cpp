#include "core/mesh/refine.hpp"

#include <gtest/gtest.h>

#include <map>

#include "core/base/random.hpp"
#include "tests/core/mesh/box.hpp"

namespace sculpt {
namespace {

/// A box with corners anywhere: its sides are no planes, its edges of all lengths.
Mesh bent_box(Random& random) {
  std::array<Vec3, 8> corners;
  for (int corner = 0; corner < 8; ++corner) {
    const double x = random.between(-0.3, 0.3), y = random.between(-0.3, 0.3), z = random.between(-0.3, 0.3);
    corners[static_cast<std::size_t>(corner)] = Vec3((corner & 1) + x, 7 * (corner >> 1 & 1) + y, (corner >> 2) + z);
  }
  return box_between(corners);
}

double volume(const Mesh& mesh) {
  double six = 0;
  for (const auto& t : mesh.triangles) six += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  return six / 6;
}

/// Each edge once to and once fro.
bool is_closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> ways;
  for (const auto& t : mesh.triangles)
    for (std::size_t at = 0; at < 3; ++at) ++ways[{t[at], t[(at + 1) % 3]}];
  for (const auto& [way, count] : ways)
    if (count != 1 || ways.find({way.second, way.first}) == ways.end()) return false;
  return true;
}

double longest_edge(const Mesh& mesh) {
  double longest = 0;
  for (const auto& t : mesh.triangles)
    for (std::size_t at = 0; at < 3; ++at)
      longest = std::max(longest, (mesh.vertices[t[at]] - mesh.vertices[t[(at + 1) % 3]]).norm());
  return longest;
}

TEST(Refine, LeavesTheSurfaceWhereItWasAndClosed) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Mesh box = bent_box(random);
    ASSERT_TRUE(is_closed(box));
    const double edge = random.between(0.2, 8);
    const Mesh fine = refine(box, edge, 1'000'000);
    EXPECT_TRUE(is_closed(fine));
    EXPECT_LE(longest_edge(fine), edge);
    EXPECT_NEAR(volume(fine), volume(box), 1e-9);
    for (std::size_t vertex = 0; vertex < box.vertices.size(); ++vertex)
      EXPECT_EQ(fine.vertices[vertex], box.vertices[vertex]);
    EXPECT_EQ(fine.vertices.size() + fine.triangles.size(), fine.triangles.size() * 3 / 2 + 2) << "Euler";
  }
}

TEST(Refine, EndsWhereThereAreEnough) {
  Random random(1);
  const Mesh box = bent_box(random);
  EXPECT_EQ(refine(box, 100, 1000).triangles, box.triangles);
  const Mesh some = refine(box, 1e-9, 100);
  EXPECT_GE(some.triangles.size(), 100u);
  EXPECT_LE(some.triangles.size(), 400u);
  EXPECT_TRUE(is_closed(some));
}

}  // namespace
}  // namespace sculpt
