#include "bench/nearest_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "tests/core/search/replay.hpp"

namespace sculpt {
namespace {

std::vector<VoxelRun> carve_by_nearest(const VoxelGrid& voxels) {
  std::vector<VoxelRun> runs;
  carve_nearest(voxels, [&](const VoxelRun& run) { runs.push_back(run); }, {});
  return runs;
}

struct Cut {
  Voxel voxel;
  int way = 0;  ///< steps through air before it
};

std::vector<Cut> cuts_of(const std::vector<VoxelRun>& runs) {
  std::vector<Cut> cuts;
  int way = 0;
  for (const VoxelRun& run : runs) {
    const int length = l1(run.first, run.last);
    if (!run.cut) way += length;
    if (!run.cut) continue;
    const Voxel all = run.last - run.first;
    const Voxel step = length == 0 ? Voxel{} : Voxel{all.i / length, all.j / length, all.k / length};
    for (int s = 0; s <= length; ++s) cuts.push_back({run.first + step * s, s == 0 ? way : 0});
    way = 0;
  }
  return cuts;
}

/// By flooding all the air: the remove voxel that is next from `at`.
Cut nearest_by_flood(const VoxelGrid& voxels, const VoxelSet& removed, Voxel at) {
  const int n = voxels.n();
  const Grid grid{n, 1, Vec3::Zero()};
  const auto place = [&](Voxel v) { return static_cast<std::size_t>(v.i + 1 + (n + 2) * (v.j + 1 + (n + 2) * v.k)); };
  std::vector<bool> seen(static_cast<std::size_t>((n + 2) * (n + 2) * (n + 1)));
  std::vector<Voxel> layer{at};
  for (int way = 0; !layer.empty(); ++way) {
    std::vector<Voxel> further, found;
    for (Voxel from : layer) {
      for (Voxel step : face_steps) {
        const Voxel v = from + step;
        if (v.i < -1 || v.j < -1 || v.k < 0 || v.i > n || v.j > n || v.k > n || seen[place(v)]) continue;
        const Label label = grid.contains(v) && !removed.contains(v) ? voxels.label(v) : Label::air;
        if (label == Label::remove) found.push_back(v);
        if (label != Label::air) continue;
        seen[place(v)] = true;
        further.push_back(v);
      }
    }
    std::sort(found.begin(), found.end(),
              [](Voxel a, Voxel b) { return std::tie(a.k, a.j, a.i) < std::tie(b.k, b.j, b.i); });
    if (!found.empty()) return {found.front(), way};
    layer = further;
  }
  return {at, 0};
}

TEST(CarveNearest, RandomShapesAreCarvedWholeWithoutTouchingWhatStays) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const VoxelGrid voxels = random_voxels(8 << seed % 2, seed);
    const Replayed done = replay(voxels, carve_by_nearest(voxels));
    ASSERT_EQ(done.fault, "");
    VoxelSet expected = voxels.stock;
    const VoxelSet enclosed = enclosed_by_flood(voxels);
    for (std::size_t w = 0; w < expected.words().size(); ++w)
      expected.words()[w] &= ~voxels.keep.words()[w] & ~enclosed.words()[w];
    ASSERT_TRUE(done.removed == expected);
  }
}

TEST(CarveNearest, EveryCutIsTheNearestByWayAndOfEqualsTheLowest) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const VoxelGrid voxels = random_voxels(8, seed);
    VoxelSet removed(8);
    Voxel at = translating_entry(8);
    for (const Cut& cut : cuts_of(carve_by_nearest(voxels))) {
      const Cut next = nearest_by_flood(voxels, removed, at);
      ASSERT_EQ(next.voxel, cut.voxel) << "at cut " << removed.size();
      ASSERT_EQ(next.way, cut.way) << "at cut " << removed.size();
      removed.insert(cut.voxel);
      at = cut.voxel;
    }
  }
}

}  // namespace
}  // namespace sculpt
