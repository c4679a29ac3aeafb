// What is inside where a file holds more than one plain closed surface: exact counts, in voxels.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/solid/voxelize.hpp"
#include "tests/core/material/shapes.hpp"

namespace sculpt {
namespace {

constexpr int n = 32;
const Grid grid{n, 1, Vec3::Zero()};

Mesh cube(double low, double high) {
  return shapes::box(Vec3::Constant(low), Vec3::Constant(high));
}

Mesh inside_out(Mesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// Each facet with corners of its own, but at the places where they were.
Mesh twice(const Mesh& mesh, bool turn_second) {
  return shapes::joined(mesh, turn_second ? inside_out(mesh) : mesh);
}

Mesh with_random_turns(Mesh mesh, double share, Random& random) {
  for (auto& t : mesh.triangles)
    if (random.unit() < share) std::swap(t[1], t[2]);
  return mesh;
}

/// A box whose sides are divided into strips, each side in its own way: no two sides share an edge.
Mesh box_with_t_junctions(const Vec3& low, const Vec3& high) {
  Mesh mesh;
  for (int side = 0; side < 6; ++side) {
    const Mesh whole = shapes::box(low, high, 1u << side);
    const auto& first = whole.triangles[0];
    const Vec3 corner = whole.vertices[first[0]], across = whole.vertices[first[1]] - corner;
    const Vec3 along = whole.vertices[first[2]] - whole.vertices[first[1]];
    const int strips = 3 + side;
    for (int s = 0; s < strips; ++s) {
      const auto id = static_cast<std::uint32_t>(mesh.vertices.size());
      const Vec3 a = corner + along * s / strips, b = corner + along * (s + 1) / strips;
      mesh.vertices.insert(mesh.vertices.end(), {a, a + across, b + across, b});
      mesh.triangles.insert(mesh.triangles.end(), {{id, id + 1, id + 2}, {id, id + 2, id + 3}});
    }
  }
  return mesh;
}

std::size_t count(const Mesh& mesh) {
  return voxelize(mesh, grid, {}).size();
}

std::size_t cubed(std::size_t edge) {
  return edge * edge * edge;
}

// The boxes of the issue: what both share was left out, and carved away.
TEST(Overlaps, WhatTwoBoxesShareIsInside) {
  const Grid mm{n, 0.1 / n, Vec3::Zero()};
  const Mesh both = shapes::joined(shapes::box(Vec3(0, 0.02, 0), Vec3(0.06, 0.08, 0.05)),
                                   shapes::box(Vec3(0.04, 0.02, 0), Vec3(0.1, 0.08, 0.05)));
  const Solid solid = find_solid(both, mm, {});
  EXPECT_EQ(solid.inside, voxelize(shapes::box(Vec3(0, 0.02, 0), Vec3(0.1, 0.08, 0.05)), mm, {}));
  EXPECT_EQ(solid.ambiguous.voxels, 0u) << "nobody means the one less the other";
}

TEST(Overlaps, APostInABallIsPartOfIt) {
  const Mesh ball = shapes::sphere(Vec3(16, 16, 18), 10, 60), post = shapes::box(Vec3(14, 14, 0), Vec3(18, 18, 18));
  const VoxelSet together = voxelize(shapes::joined(ball, post), grid, {});
  VoxelSet expected = voxelize(ball, grid, {});
  for_each_voxel(voxelize(post, grid, {}), [&](Voxel v) { expected.insert(v); });
  EXPECT_EQ(together, expected);
}

TEST(Overlaps, FacetsGivenTwiceAreOneSurface) {
  for (bool turned : {false, true}) {
    SCOPED_TRACE(turned);
    EXPECT_EQ(count(twice(cube(4, 20), turned)), cubed(16));
    EXPECT_EQ(count(twice(twice(cube(4, 20), turned), turned)), cubed(16));
    Mesh some = cube(4, 20);
    for (std::size_t facet : {0u, 1u, 4u}) some.triangles.push_back(some.triangles[facet]);
    if (turned)
      for (std::size_t facet = 12; facet < 15; ++facet) std::swap(some.triangles[facet][1], some.triangles[facet][2]);
    EXPECT_EQ(count(some), cubed(16));
  }
}

TEST(Overlaps, AlmostTheSameSurfaceTwiceIsOneBody) {
  Random random(3);
  Mesh second = shapes::sphere(Vec3(16, 16, 16), 10, 40);
  const std::size_t once = count(second);
  for (Vec3& vertex : second.vertices) vertex += 1e-5 * Vec3(random.unit(), random.unit(), random.unit());
  EXPECT_EQ(count(shapes::joined(shapes::sphere(Vec3(16, 16, 16), 10, 40), second)), once);
}

TEST(Overlaps, ASheetGivenTwiceTakesNothingAway) {
  const Mesh sheet = shapes::box(Vec3(2, 2, 10.2), Vec3(30, 30, 11), 0b010000);
  EXPECT_EQ(count(shapes::joined(cube(4, 20), twice(sheet, true))), cubed(16));
}

TEST(Overlaps, FacetsOfOneShellAreTurnedAlike) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Mesh ball = shapes::sphere(Vec3(14, 16, 16), 10, 40), post = shapes::box(Vec3(10, 10, 1), Vec3(18, 18, 25));
    const Mesh clean = shapes::joined(ball, post);
    const double share = seed % 2 == 0 ? 0.2 : 0.5;
    EXPECT_EQ(voxelize(with_random_turns(clean, share, random), grid, {}), voxelize(clean, grid, {}));
  }
}

TEST(Overlaps, AShellInsideOutIsTurnedAndTold) {
  const Mesh low = cube(2, 14), high = cube(10, 28);
  const std::size_t shared = cubed(4), both = cubed(12) + cubed(18) - shared;
  EXPECT_EQ(count(shapes::joined(inside_out(low), inside_out(high))), both);
  const Solid solid = find_solid(shapes::joined(inside_out(low), high), grid, {});
  EXPECT_EQ(solid.inside.size(), both);
  EXPECT_EQ(solid.ambiguous.voxels, shared) << "the file could mean the difference";
  EXPECT_EQ(solid.ambiguous.low, (Voxel{10, 10, 10}));
  EXPECT_EQ(solid.ambiguous.high, (Voxel{13, 13, 13}));
}

TEST(Overlaps, AShellInAnotherIsACavityIfItIsTurnedAgainstIt) {
  const Mesh outer = cube(2, 30), middle = inside_out(cube(6, 26)), inner = cube(10, 20);
  const std::size_t hollow = cubed(28) - cubed(20), with_island = hollow + cubed(10);
  for (bool whole_file_inside_out : {false, true}) {
    SCOPED_TRACE(whole_file_inside_out);
    const auto solid_of = [&](const Mesh& mesh) {
      return find_solid(whole_file_inside_out ? inside_out(mesh) : mesh, grid, {});
    };
    EXPECT_EQ(solid_of(shapes::joined(outer, middle)).inside.size(), hollow);
    EXPECT_EQ(solid_of(shapes::joined(outer, middle)).ambiguous.voxels, 0u);
    const Solid island = solid_of(shapes::joined(inner, shapes::joined(middle, outer)));
    EXPECT_EQ(island.inside.size(), with_island);
    EXPECT_EQ(island.ambiguous.voxels, 0u);
  }
}

TEST(Overlaps, AShellInAnotherThatIsTurnedAlikeIsSolidAndTold) {
  const Solid solid = find_solid(shapes::joined(cube(2, 30), cube(6, 26)), grid, {});
  EXPECT_EQ(solid.inside.size(), cubed(28));
  EXPECT_EQ(solid.ambiguous.voxels, cubed(20)) << "a careless export of a hollow cube looks the same";
}

TEST(Overlaps, CavitiesThatOverlapAreBothHollow) {
  const Mesh cavities = inside_out(shapes::joined(cube(6, 16), cube(12, 24)));
  EXPECT_EQ(count(shapes::joined(cube(2, 30), cavities)), cubed(28) - cubed(10) - cubed(12) + cubed(4));
}

TEST(Overlaps, ABodyThatReachesIntoACavityFillsIt) {
  const Mesh hollow = shapes::joined(cube(2, 30), inside_out(cube(6, 26)));
  const Mesh rod = shapes::box(Vec3(14, 14, 0), Vec3(18, 18, 32));
  EXPECT_EQ(count(shapes::joined(hollow, rod)), cubed(28) - cubed(20) + 4 * 4 * (20 + 2 + 2));
}

TEST(Overlaps, ShellsThatTouchInAFaceAreOneBody) {
  const Vec3 low(4, 4, 4), high(14, 14, 14), step(10, 0, 0);
  const Mesh left = shapes::box(low, high), right = shapes::box(low + step, high + step);
  for (const Mesh& other : {right, inside_out(right), box_with_t_junctions(low + step, high + step)})
    for (const Mesh& one : {left, inside_out(left)}) EXPECT_EQ(count(shapes::joined(one, other)), 2 * cubed(10));
  Mesh bricks;  // 2 x 2 x 2
  for (int corner = 0; corner < 8; ++corner)
    bricks = shapes::joined(
        bricks,
        shapes::transformed(left, Frame(Eigen::Translation3d(Vec3(corner & 1, corner >> 1 & 1, corner >> 2) * 10))));
  EXPECT_EQ(count(bricks), 8 * cubed(10));
}

TEST(Overlaps, ShellsThatTouchInAnEdgeOrACornerStayTwo) {
  const Mesh cube_at_0 = cube(4, 14);
  for (const Vec3& step : {Vec3(10, 10, 0), Vec3(10, 10, 10)}) {
    const Mesh other = shapes::transformed(cube_at_0, Frame(Eigen::Translation3d(step)));
    EXPECT_EQ(count(shapes::joined(cube_at_0, other)), 2 * cubed(10));
    EXPECT_EQ(count(shapes::joined(cube_at_0, inside_out(other))), 2 * cubed(10));
  }
}

TEST(Overlaps, BodiesWhoseSidesDoNotShareEdgesAreUnitedToo) {
  const Mesh left = box_with_t_junctions(Vec3(2, 4, 4), Vec3(20, 20, 20));
  const Mesh right = box_with_t_junctions(Vec3(12, 4, 4), Vec3(30, 20, 20));
  EXPECT_EQ(count(left), 18u * 16 * 16);
  EXPECT_EQ(count(inside_out(left)), 18u * 16 * 16);
  EXPECT_EQ(count(shapes::joined(left, right)), 28u * 16 * 16);
  EXPECT_EQ(count(shapes::joined(left, inside_out(cube(6, 10)))), 18u * 16 * 16 - cubed(4));
}

TEST(Overlaps, SidesTurnedByChanceAreDecidedByEvenAndOdd) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Mesh outer = box_with_t_junctions(Vec3(4, 4, 4), Vec3(20, 20, 20));
    const Mesh hollow = shapes::joined(outer, box_with_t_junctions(Vec3(8, 8, 8), Vec3(14, 14, 14)));
    for (const auto& [clean, voxels] : {std::pair(outer, cubed(16)), std::pair(hollow, cubed(16) - cubed(6))}) {
      Mesh mesh = with_random_turns(clean, 0.5, random);
      std::copy_n(clean.triangles.begin(), 6, mesh.triangles.begin());  // the side at low x is as it should be,
      for (std::size_t facet = 6; facet < 14; ++facet) {                // the one at high x is not
        const auto& t = clean.triangles[facet];
        mesh.triangles[facet] = {t[0], t[2], t[1]};
      }
      EXPECT_EQ(count(mesh), voxels);
    }
  }
}

TEST(Overlaps, HolesDoNotKeepBodiesFromBeingUnited) {
  Mesh ball = shapes::sphere(Vec3(14, 16, 16), 10, 60);
  const std::size_t whole = count(shapes::joined(ball, cube(12, 30)));
  std::erase_if(ball.triangles, [&](const auto& t) { return (ball.vertices[t[0]] - Vec3(4, 16, 16)).norm() < 0.8; });
  for (const Mesh& holed : {ball, inside_out(ball)})
    EXPECT_NEAR(static_cast<double>(count(shapes::joined(holed, cube(12, 30)))), static_cast<double>(whole), 10);
}

/// Boxes at whole coordinates: whether a voxel is in one of them needs no geometry.
TEST(Overlaps, ManyBodiesAreTheirUnion) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Mesh all;
    VoxelSet expected(n);
    const int bodies = seed == 0 ? 44 : static_cast<int>(random.between(2, 12));
    for (int body = 0; body < bodies; ++body) {
      std::array<int, 3> low{}, high{};
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = static_cast<int>(random.between(0, n - 6));
        high[axis] = std::min(n, low[axis] + static_cast<int>(random.between(2, 16)));
      }
      const Mesh box = shapes::box(Vec3(low[0], low[1], low[2]), Vec3(high[0], high[1], high[2]));
      all = shapes::joined(all, random.unit() < 0.2 ? twice(box, random.unit() < 0.5) : box);
      for (int k = low[2]; k < high[2]; ++k)
        for (int j = low[1]; j < high[1]; ++j)
          for (int i = low[0]; i < high[0]; ++i) expected.insert({i, j, k});
    }
    EXPECT_EQ(voxelize(all, grid, {}), expected);
  }
}

TEST(Overlaps, ThousandsOfShellsAreLookedAtInTime) {
  Mesh grains;
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 16; ++i)
        grains = shapes::joined(std::move(grains),
                                shapes::box(Vec3(2 * i, 2 * j, 2 * k), Vec3(2 * i + 1, 2 * j + 1, 2 * k + 1)));
  EXPECT_EQ(count(grains), cubed(16));
  EXPECT_EQ(count(shapes::joined(cube(-1, 33), inside_out(grains))), cubed(n) - cubed(16)) << "a foam";
}

TEST(Overlaps, FacetsInOneAnotherByTheThousandAreRefused) {
  Mesh pile = shapes::box(Vec3(1, 1, 1), Vec3(31, 31, 31), 0b010000);
  const auto facets = pile.triangles;
  for (std::uint32_t copy = 1; copy < 12000; ++copy) {
    const auto id = static_cast<std::uint32_t>(pile.vertices.size());
    for (std::uint32_t v = 0; v < 8; ++v) pile.vertices.push_back(pile.vertices[v] + Vec3(0, 0, 0.002 * copy));
    for (const auto& t : facets) pile.triangles.push_back({t[0] + id, t[1] + id, t[2] + id});
  }
  EXPECT_EQ(shapes::error_code([&] { count(pile); }), "mesh_not_solid");
}

}  // namespace
}  // namespace sculpt
