#include "core/search/voxel_search.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

#include "core/mesh/mesh_file.hpp"
#include "core/solid/placement.hpp"
#include "core/solid/voxelize.hpp"
#include "tests/core/search/replay.hpp"

namespace sculpt {
namespace {

std::vector<VoxelRun> carve_voxels(const VoxelGrid& voxels) {
  std::vector<VoxelRun> runs;
  carve_voxelwise(voxels, [&](const VoxelRun& run) { runs.push_back(run); }, {});
  return runs;
}

/// Replays clean, and removes all that is not enclosed.
Replayed expect_carved(const VoxelGrid& voxels) {
  const Replayed done = replay(voxels, carve_voxels(voxels));
  EXPECT_EQ(done.fault, "");
  VoxelSet expected = voxels.stock;
  const VoxelSet enclosed = enclosed_by_flood(voxels);
  for (std::size_t w = 0; w < expected.words().size(); ++w)
    expected.words()[w] &= ~voxels.keep.words()[w] & ~enclosed.words()[w];
  EXPECT_TRUE(done.removed == expected);
  return done;
}

VoxelGrid full(int n) {
  return {VoxelSet(n, true), VoxelSet(n)};
}

double moves_a_voxel(const Replayed& done) {
  return static_cast<double>(done.cut + done.travelled) / static_cast<double>(done.cut);
}

TEST(CarveVoxelwise, RandomShapesAreCarvedWholeWithoutTouchingWhatStays) {
  int with_cavity = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const VoxelGrid voxels = random_voxels(seed % 10 == 9 ? 32 : 8 << seed % 2, seed);
    expect_carved(voxels);
    with_cavity += enclosed_by_flood(voxels).size() > 0;
    if (HasFailure()) break;
  }
  EXPECT_GT(with_cavity, 50) << "the random shapes no longer enclose anything";
}

TEST(CarveVoxelwise, TheSameVoxelsGiveTheSameRuns) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const VoxelGrid voxels = random_voxels(16, seed);
    const auto first = carve_voxels(voxels), second = carve_voxels(voxels);
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t r = 0; r < first.size(); ++r) {
      ASSERT_EQ(first[r].cut, second[r].cut);
      ASSERT_EQ(first[r].first, second[r].first);
      ASSERT_EQ(first[r].last, second[r].last);
    }
  }
}

TEST(CarveVoxelwise, AnEmptyTargetIsCarvedAllButWithoutADetour) {
  const Replayed done = expect_carved(full(16));
  EXPECT_EQ(done.cut, 16u * 16 * 16);
  EXPECT_LE(done.travelled, 60u) << "the way home, and a detour or two";
}

TEST(CarveVoxelwise, NothingToRemoveIsNothingToDo) {
  EXPECT_TRUE(carve_voxels({VoxelSet(8, true), VoxelSet(8, true)}).empty());
  EXPECT_TRUE(carve_voxels({VoxelSet(8), VoxelSet(8)}).empty());
}

TEST(CarveVoxelwise, ASingleKeepVoxelIsLeftStanding) {
  for (Voxel keep : {Voxel{4, 4, 4}, {0, 0, 7}, {7, 3, 0}, {3, 4, 7}}) {
    VoxelGrid voxels = full(8);
    voxels.keep.insert(keep);
    EXPECT_EQ(expect_carved(voxels).cut, 8u * 8 * 8 - 1);
  }
}

TEST(CarveVoxelwise, AnEnclosedCavityStays) {
  VoxelGrid voxels = full(16);
  for (int k = 4; k < 12; ++k)
    for (int j = 4; j < 12; ++j)
      for (int i = 4; i < 12; ++i)
        if (i < 6 || j < 6 || k < 6 || i > 9 || j > 9 || k > 9) voxels.keep.insert({i, j, k});
  EXPECT_EQ(enclosed_by_flood(voxels).size(), 4u * 4 * 4);
  expect_carved(voxels);
}

TEST(CarveVoxelwise, AJarIsEmptiedThroughANeckOfOneVoxel) {
  VoxelGrid voxels = full(32);
  for (int k = 0; k < 24; ++k)
    for (int j = 8; j < 24; ++j)
      for (int i = 8; i < 24; ++i) {
        const bool wall = i < 10 || j < 10 || k < 2 || i > 21 || j > 21 || k > 21;
        const bool neck = i == 16 && j == 15 && k > 2;
        if (wall && !neck) voxels.keep.insert({i, j, k});
      }
  EXPECT_EQ(enclosed_by_flood(voxels).size(), 0u);
  EXPECT_LE(moves_a_voxel(expect_carved(voxels)), 1.05);
}

TEST(CarveVoxelwise, SeparatedSectionsAreCarvedOneAfterTheOtherEachFromNearACorner) {
  VoxelGrid voxels = full(16);
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 16; ++j)
      for (int i = 6; i < 8; ++i) voxels.keep.insert({i, j, k});
  for (int k = 0; k < 16; ++k)
    voxels.keep.insert({15, 0, k}), voxels.keep.insert({15, 15, k}), voxels.keep.insert({8, 15, k});
  expect_carved(voxels);
  std::vector<bool> sides;
  std::vector<Voxel> starts;
  for (const VoxelRun& run : carve_voxels(voxels)) {
    if (!run.cut || (!sides.empty() && sides.back() == (run.first.i > 7))) continue;
    sides.push_back(run.first.i > 7);
    starts.push_back(run.first);
  }
  EXPECT_EQ(sides, (std::vector<bool>{false, true}));
  EXPECT_EQ(starts[0], (Voxel{0, 0, 15})) << "the corner at the entry";
  EXPECT_TRUE(l1(starts[1], {15, 0, 15}) == 1 || l1(starts[1], {15, 15, 15}) == 1 || l1(starts[1], {15, 0, 0}) == 1 ||
              l1(starts[1], {15, 15, 0}) == 1);
}

TEST(CarveVoxelwise, ASectionBehindAirThatAnotherSectionSealsIsCarvedAfterIt) {
  VoxelGrid voxels{VoxelSet(8, true), VoxelSet(8, true)};
  for (int i = 0; i < 6; ++i) voxels.keep.erase({i, 3, 4});
  for (int i : {2, 3}) voxels.stock.erase({i, 3, 4});
  EXPECT_EQ(expect_carved(voxels).cut, 4u);
}

TEST(CarveVoxelwise, StopsWhenAskedAndSaysHowFarItIs) {
  const VoxelGrid voxels = random_voxels(32, 5);
  std::stop_source source;
  std::uint64_t done = 0, total = 0;
  const Watch watch{source.get_token(), [&](const Progress& progress) {
                      EXPECT_GE(progress.done, done);
                      done = progress.done;
                      total = progress.total;
                      if (done > total / 2) source.request_stop();
                    }};
  EXPECT_THROW(carve_voxelwise(
                   voxels, [](const VoxelRun&) {}, watch),
               Cancelled);
  EXPECT_GT(done, total / 2);
  EXPECT_LT(done, total);
}

TEST(CarveVoxelwise, DavidAt64TakesFewMovesMoreThanVoxels) {
  const char* folder = std::getenv("SCULPT_SHARED_DATA");
  std::ifstream file((folder != nullptr ? std::string(folder) : SOURCE_DIR "/../shared/data") + "/meshes/david.stl",
                     std::ios::binary);
  if (!file) GTEST_SKIP() << "shared data folder without meshes/david.stl";
  std::ostringstream bytes;
  bytes << file.rdbuf();
  const Grid grid{64, 0.005, Vec3::Zero()};
  const Mesh mesh = place_mesh(load_mesh(bytes.str(), "stl", 1 << 30, {}), {}, grid);
  const Replayed done = expect_carved({VoxelSet(64, true), voxelize(mesh, grid, {})});
  std::cout << done.cut << " voxels cut, " << done.travelled << " steps travelled, " << moves_a_voxel(done)
            << " moves a voxel\n";
  EXPECT_LE(moves_a_voxel(done), 1.02);
}

}  // namespace
}  // namespace sculpt
