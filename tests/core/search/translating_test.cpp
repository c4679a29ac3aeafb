#include "core/search/translating.hpp"

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

/// Replays clean, and removes all that is not enclosed.
Replayed expect_carved(const VoxelGrid& voxels) {
  const Replayed done = replay(voxels, carve(voxels));
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

std::string figures(const Replayed& done) {
  return std::to_string(done.cut) + " voxels cut, " + std::to_string(done.travelled) + " steps travelled, " +
         std::to_string(static_cast<double>(done.cut + done.travelled) / static_cast<double>(done.cut)) +
         " moves a voxel";
}

TEST(CarveTranslating, RandomShapesAreCarvedWholeWithoutTouchingWhatStays) {
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

TEST(CarveTranslating, TheSameVoxelsGiveTheSameRuns) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const VoxelGrid voxels = random_voxels(16, seed);
    const auto first = carve(voxels), second = carve(voxels);
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t r = 0; r < first.size(); ++r) {
      ASSERT_EQ(first[r].cut, second[r].cut);
      ASSERT_EQ(first[r].first, second[r].first);
      ASSERT_EQ(first[r].last, second[r].last);
    }
  }
}

TEST(CarveTranslating, AFullStockIsOneBoustrophedon) {
  const Replayed done = expect_carved(full(16));
  EXPECT_EQ(done.cut, 16u * 16 * 16);
  EXPECT_LE(done.travelled, 32u) << "in and out only";
}

TEST(CarveTranslating, NothingToRemoveIsNothingToDo) {
  EXPECT_TRUE(carve({VoxelSet(8, true), VoxelSet(8, true)}).empty());
  EXPECT_TRUE(carve({VoxelSet(8), VoxelSet(8)}).empty());
}

TEST(CarveTranslating, AnEnclosedCavityStays) {
  VoxelGrid voxels = full(16);
  for (int k = 4; k < 12; ++k)
    for (int j = 4; j < 12; ++j)
      for (int i = 4; i < 12; ++i)
        if (i < 6 || j < 6 || k < 6 || i > 9 || j > 9 || k > 9) voxels.keep.insert({i, j, k});
  EXPECT_EQ(enclosed_by_flood(voxels).size(), 4u * 4 * 4);
  expect_carved(voxels);
}

TEST(CarveTranslating, ABottleIsEmptiedThroughItsNeck) {
  VoxelGrid voxels = full(32);
  for (int k = 0; k < 24; ++k)
    for (int j = 8; j < 24; ++j)
      for (int i = 8; i < 24; ++i) {
        const bool wall = i < 10 || j < 10 || k < 2 || i > 21 || j > 21 || k > 21;
        const bool neck = i == 16 && j == 15 && k > 2;
        if (wall && !neck) voxels.keep.insert({i, j, k});
      }
  EXPECT_EQ(enclosed_by_flood(voxels).size(), 0u);
  expect_carved(voxels);
}

TEST(CarveTranslating, ABlockOpenInTheMiddleOfAFaceOnlyIsCarved) {
  VoxelGrid voxels{VoxelSet(16, true), VoxelSet(16, true)};
  for (int k = 8; k < 12; ++k)
    for (int j = 8; j < 12; ++j)
      for (int i = 8; i < 12; ++i) voxels.keep.erase({i, j, k});
  for (int k = 12; k < 16; ++k) voxels.keep.erase({9, 10, k});
  EXPECT_EQ(expect_carved(voxels).cut, 64u + 4u);
}

TEST(CarveTranslating, TheFloorIsNoWayIn) {
  VoxelGrid voxels{VoxelSet(8, true), VoxelSet(8, true)};
  voxels.keep.erase({3, 3, 0});
  EXPECT_TRUE(carve(voxels).empty());
}

TEST(CarveTranslating, AWindingTunnelIsFollowedToItsEnd) {
  VoxelGrid voxels{VoxelSet(32, true), VoxelSet(32, true)};
  for (int j = 1; j < 31; j += 2) {
    for (int i = 1; i < 31; ++i) voxels.keep.erase({i, j, 16});
    if (j < 29) voxels.keep.erase({j % 4 == 1 ? 30 : 1, j + 1, 16});
  }
  voxels.keep.erase({0, 1, 16});
  EXPECT_GT(expect_carved(voxels).cut, 400u);
}

TEST(CarveTranslating, StopsWhenAskedAndSaysHowFarItIs) {
  const VoxelGrid voxels = random_voxels(16, 5);
  const Octree octree = build_octree(voxels, {});
  const BlockGraph graph = build_block_graph(octree, {});
  std::stop_source source;
  std::uint64_t done = 0, total = 0;
  const Watch watch{source.get_token(), [&](const Progress& progress) {
                      EXPECT_GE(progress.done, done);
                      done = progress.done;
                      total = progress.total;
                      if (done > total / 2) source.request_stop();
                    }};
  EXPECT_THROW(carve_translating(
                   voxels, octree, graph, [](const VoxelRun&) {}, watch),
               Cancelled);
  EXPECT_GT(done, total / 2);
}

TEST(CarveTranslating, TheReplayOfTheseTestsFindsWhatIsWrong) {
  VoxelGrid voxels = full(8);
  voxels.keep.insert({3, 3, 0});
  const std::vector<VoxelRun> runs = carve(voxels);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    SCOPED_TRACE("run " + std::to_string(r));
    auto dropped = runs, moved = runs, doubled = runs;
    dropped.erase(dropped.begin() + static_cast<std::ptrdiff_t>(r));
    moved[r].last.j += 1;
    doubled.insert(doubled.begin() + static_cast<std::ptrdiff_t>(r), runs[r]);
    EXPECT_NE(replay(voxels, dropped).fault, "");
    EXPECT_NE(replay(voxels, moved).fault, "");
    EXPECT_NE(replay(voxels, doubled).fault, "");
  }
}

TEST(CarveTranslating, DavidAt64TakesFewMovesMoreThanVoxels) {
  const char* folder = std::getenv("SCULPT_SHARED_DATA");
  std::ifstream file((folder != nullptr ? std::string(folder) : SOURCE_DIR "/../shared/data") + "/meshes/david.stl",
                     std::ios::binary);
  if (!file) GTEST_SKIP() << "shared data folder without meshes/david.stl";
  std::ostringstream bytes;
  bytes << file.rdbuf();
  const Grid grid{64, 0.005, Vec3::Zero()};
  const Mesh mesh = place_mesh(load_mesh(bytes.str(), "stl", 1 << 30, {}), {}, grid);
  const Replayed done = expect_carved({VoxelSet(64, true), voxelize(mesh, grid, {})});
  std::cout << figures(done) << '\n';
  EXPECT_LE(static_cast<double>(done.cut + done.travelled), 1.05 * static_cast<double>(done.cut)) << figures(done);
}

}  // namespace
}  // namespace sculpt
