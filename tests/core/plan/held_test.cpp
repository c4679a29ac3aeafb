// No removal of an arm's plan frees a piece of material, but for parts of the target that nothing can hold.
#include <gtest/gtest.h>

#include "core/material/loose_pieces.hpp"
#include "core/trajectory/keyframe.hpp"
#include "core/trajectory/reader.hpp"
#include "tests/core/material/shapes.hpp"
#include "tests/core/plan/jobs.hpp"
#include "tests/core/plan/soundness.hpp"

namespace sculpt {
namespace {

/// Mushroom; bridge; ring on a post; two arms that nearly meet; a block in the air; the same, hollow and open below.
VoxelSet overhang(int n, std::uint64_t number) {
  VoxelSet target(n);
  const int q = n / 4, half = n / 2, last = n - 1;
  switch (number) {
    case 0:
      shapes::fill(target, {half, half, 0}, {half, half, half});
      shapes::fill(target, {1, 1, half}, {last - 1, last - 1, half + q});
      break;
    case 1:
      shapes::fill(target, {0, q, 0}, {1, half, half});
      shapes::fill(target, {last - 1, q, 0}, {last, half, half});
      shapes::fill(target, {0, q, half}, {last, half, half + 1});
      break;
    case 2:
      shapes::fill(target, {1, 1, half}, {last - 1, last - 1, half + 1});
      for (int k = half; k <= half + 1; ++k)
        for (int j = q; j <= last - q; ++j)
          for (int i = q; i <= last - q; ++i) target.erase({i, j, k});
      shapes::fill(target, {1, 1, 0}, {2, 2, half});
      break;
    case 3:
      shapes::fill(target, {0, half, 0}, {1, half, last});
      shapes::fill(target, {1, half, half}, {half - 1, half, half});
      shapes::fill(target, {last, 1, 0}, {last, last - 1, half - 1});
      shapes::fill(target, {half + 1, half, half - 1}, {last, half, half - 1});
      break;
    default:
      shapes::fill(target, {q, q, half}, {last - q, last - q, half + q});
      if (number > 4)
        for (int k = half; k < half + q; ++k)
          for (int j = q + 1; j < last - q; ++j)
            for (int i = q + 1; i < last - q; ++i) target.erase({i, j, k});
  }
  return target;
}

/// Floods all that stands after every single voxel. The stock stands on the floor.
void expect_held(const std::filesystem::path& trajectory, const VoxelGrid& voxels) {
  VoxelSet standing = voxels.stock;
  const VoxelSet unheld = find_unheld(voxels);
  std::ifstream in(trajectory, std::ios::binary);
  TrajectoryReader reader(in);
  while (const auto keyframe = reader.next()) {
    const int count = run_length(*keyframe);
    const Voxel way = keyframe->last - keyframe->first;
    for (int m = 0; m < count; ++m) {
      standing.erase(
          keyframe->first +
          Voxel{way.i / std::max(1, count - 1), way.j / std::max(1, count - 1), way.k / std::max(1, count - 1)} * m);
      const VoxelSet loose = find_loose(standing);
      for (std::size_t word = 0; word < loose.words().size(); ++word)
        ASSERT_EQ(loose.words()[word] & ~unheld.words()[word], 0u) << "line " << reader.line();
    }
  }
}

std::uint64_t expect_held(const VoxelSet& target, const std::string& search, std::uint64_t seed) {
  Job job = make_job(shipped_cell_files("panda-turntable"), target, seed);
  job.search = parse_search(search);
  const ScratchFile file;
  const JobResult result = run_job(job, file.path(), {});
  expect_sound(result);
  expect_held(file.path(), result.voxels);
  std::uint64_t holding = 0;
  for (const auto& [reason, voxels] : result.report.residue) holding += reason == Reason::loose_piece ? voxels : 0;
  return holding;
}

TEST(Held, SweepsUnderOverhangsFreeNothing) {
  for (std::uint64_t number = 0; number < 6; ++number) {
    SCOPED_TRACE("shape " + std::to_string(number));
    const std::uint64_t holding = expect_held(overhang(16, number), "sweep", number);
    EXPECT_EQ(holding > 0, number == 5) << "only what the tool cannot clear out needs something to hold it";
  }
}

TEST(Held, OctreeUnderOverhangsFreesNothing) {
  for (std::uint64_t number = 0; number < 6; ++number) {
    SCOPED_TRACE("shape " + std::to_string(number));
    const std::uint64_t holding = expect_held(overhang(8, number), "octree", number);
    EXPECT_EQ(holding > 0, number == 5);
  }
}

TEST(Held, RandomTargetsWithPartsInTheAirAreHeld) {
  for (std::uint64_t seed = 200; seed < 206; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_held(random_target(16, seed), "sweep", seed);
  }
}

TEST(Held, WhatHangsOnNothingIsToldBeforePlanning) {
  const Job job = make_job(shipped_cell_files("gantry"), overhang(8, 4));
  std::uint64_t told = 0;
  const Watch watch{{}, [&](const Progress& progress) {
                      if (told == 0 && progress.stage == Stage::plan) {
                        EXPECT_EQ(progress.done, 0u);
                        EXPECT_GT(progress.doubts.loose_keep, 0u);
                      }
                      told = std::max(told, progress.doubts.loose_keep);
                    }};
  const ScratchFile file;
  const JobResult result = run_job(job, file.path(), watch);
  EXPECT_EQ(told, result.report.voxels.loose_keep);
  EXPECT_GE(result.report.voxels.freed, told) << "a translating robot frees it";
  EXPECT_TRUE(result.report.verify.clean);
}

}  // namespace
}  // namespace sculpt
