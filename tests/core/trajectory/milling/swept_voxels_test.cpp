#include "core/trajectory/milling/swept_voxels.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/trajectory/quantum.hpp"

namespace sculpt {
namespace {

const std::vector<std::array<int, 3>> directions{{0, 0, 1}, {1, 0, 0}, {0, -1, 0}, {1, 0, 1}, {1, 1, 1}, {26, 0, -15}};

Cutter random_cutter(Random& random) {
  Cutter cutter;
  cutter.kind = static_cast<CutterKind>(random.next() % 3);
  cutter.radius_m = random.between(0.001, 0.02);
  cutter.corner_radius_m = cutter.kind == CutterKind::ball   ? cutter.radius_m
                           : cutter.kind == CutterKind::bull ? random.between(0.1, 0.9) * cutter.radius_m
                                                             : 0;
  cutter.flute_m = cutter.corner_radius_m + random.between(0.001, 0.05);
  return cutter;
}

QuantaPoint random_tip(Random& random) {
  QuantaPoint tip{};
  for (auto& value : tip) value = static_cast<std::int64_t>(random.between(-200'000, 1'000'000));
  return tip;
}

/// Far inside or outside of what the cutter sweeps, by dense sampling of the way: nothing near its surface.
enum class Side { in, out, near };
Side sampled(const Cutter& cutter, const Vec3& axis, const QuantaPoint& from, const QuantaPoint& to,
             const Vec3& point) {
  const auto place = [](const QuantaPoint& q) { return Vec3(from_quanta(q[0]), from_quanta(q[1]), from_quanta(q[2])); };
  constexpr int samples = 400;
  const double near_m = 0.0004;
  bool any_near = false;
  for (int step = 0; step <= samples; ++step) {
    const Vec3 tip = place(from) + (place(to) - place(from)) * step / samples, off = point - tip;
    const double up = off.dot(axis), r = (off - up * axis).norm();
    const auto inside = [&](double more) {
      if (r > cutter.radius_m + more || up > cutter.flute_m + more) return false;
      return up + more >= cutter.height_m(std::max(0.0, std::min(r - more, cutter.radius_m)));
    };
    if (inside(-near_m)) return Side::in;
    any_near = any_near || inside(near_m);
  }
  return any_near ? Side::near : Side::out;
}

TEST(SweptVoxels, AreThoseThatDenseSamplesSay) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Cutter cutter = random_cutter(random);
    const auto& direction = directions[random.next() % directions.size()];
    const Vec3 axis = Vec3(direction[0], direction[1], direction[2]).normalized();
    const SweptCutter swept(cutter, direction, 0);
    const QuantaPoint from = random_tip(random);
    QuantaPoint to = from;
    for (auto& value : to) value += static_cast<std::int64_t>(random.between(-150'000, 150'000));
    // Where a cutter climbs its cylinders count where they are above both bases only: all of it is asked of level ways.
    const bool is_level = seed % 2 == 0 && cutter.kind != CutterKind::bull;
    if (is_level) {
      const std::int64_t b = direction[0], c = direction[1], d = direction[2];
      const auto a = static_cast<std::int64_t>(random.between(-5000, 5000)),
                 other = static_cast<std::int64_t>(random.between(-5000, 5000));
      to = {from[0] + c * a - d * other, from[1] - b * a, from[2] + b * other};
    }
    for (int n = 0; n < 200; ++n) {
      const Vec3 point = Vec3(from_quanta(from[0]), from_quanta(from[1]), from_quanta(from[2])) +
                         Vec3(random.between(-0.05, 0.05), random.between(-0.05, 0.05), random.between(-0.05, 0.05));
      const QuantaPoint at{std::llround(point.x() * 1e7), std::llround(point.y() * 1e7), std::llround(point.z() * 1e7)};
      const Side side = sampled(cutter, axis, from, to, point);
      if (side == Side::near) continue;
      if (side == Side::out || is_level) {
        EXPECT_EQ(swept.sweeps(from, to, at), side == Side::in);
      }
    }
  }
}

TEST(SweptVoxels, RowsHoldExactlyThePointsThatAreSwept) {
  const Grid grid{32, 0.003, Vec3(-0.01, 0.002, 0)};
  const VoxelCentres centres(grid);
  const VoxelSet all(grid.n, true);
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const SweptCutter swept(random_cutter(random), directions[random.next() % directions.size()],
                            random.between(0, 0.0005));
    const QuantaPoint from = random_tip(random), to = seed % 7 == 0 ? from : random_tip(random);
    VoxelSet by_rows(grid.n), by_points(grid.n);
    swept.for_each_run(centres, from, to, all, [&](const SweptCutter::Run& run) {
      for (int i = run.first; i <= run.last; ++i) by_rows.insert({i, run.j, run.k});
    });
    for (int k = 0; k < grid.n; ++k)
      for (int j = 0; j < grid.n; ++j)
        for (int i = 0; i < grid.n; ++i)
          if (swept.sweeps(from, to, {centres.at(0, i), centres.at(1, j), centres.at(2, k)}))
            by_points.insert({i, j, k});
    EXPECT_EQ(by_rows, by_points);
  }
}

TEST(SweptVoxels, BesideTheGridThereAreNone) {
  const Grid grid{8, 0.001, Vec3::Zero()};
  const VoxelCentres centres(grid);
  const VoxelSet all(grid.n, true);
  const SweptCutter swept({CutterKind::ball, 0.002, 0.002, 0.01}, {0, 0, 1}, 0);
  for (const std::size_t axis : {0, 1, 2})
    for (const std::int64_t place : {-900'000, 60'000 + 80'000, 900'000}) {
      QuantaPoint from{40'000, 40'000, 40'000};
      from[axis] = axis == 2 && place < 0 ? -200'000 : place;
      QuantaPoint to = from;
      to[(axis + 1) % 3] += axis == 1 ? 0 : 10'000;
      swept.for_each_run(centres, from, to, all,
                         [&](const SweptCutter::Run&) { ADD_FAILURE() << axis << " " << place; });
    }
}

TEST(SweptVoxels, AMarginMakesLessOfThem) {
  Random random(5);
  const Cutter cutter = random_cutter(random);
  const SweptCutter whole(cutter, {0, 0, 1}, 0), less(cutter, {0, 0, 1}, 0.0005);
  const QuantaPoint from{0, 0, 0}, to{100'000, 30'000, 0};
  int whole_points = 0, less_points = 0;
  for (int n = 0; n < 20000; ++n) {
    const QuantaPoint at{static_cast<std::int64_t>(random.between(-300'000, 400'000)),
                         static_cast<std::int64_t>(random.between(-300'000, 300'000)),
                         static_cast<std::int64_t>(random.between(-100'000, 600'000))};
    const bool in_less = less.sweeps(from, to, at), in_whole = whole.sweeps(from, to, at);
    EXPECT_TRUE(in_whole || !in_less);
    whole_points += in_whole;
    less_points += in_less;
  }
  EXPECT_GT(less_points, 0);
  EXPECT_LT(less_points, whole_points);
}

}  // namespace
}  // namespace sculpt
