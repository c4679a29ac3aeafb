// Good trajectories with one thing broken, written with a fresh hash: each must be found. Where a random change may be
// harmless, a plain dense sampling (written here, sharing nothing) decides.
#include <gtest/gtest.h>

#include "core/trajectory/keyframe.hpp"
#include "core/trajectory/quantum.hpp"
#include "tests/core/verify/small_cells.hpp"

namespace sculpt {
namespace {

constexpr int n = 8;
constexpr int runs = 25;

struct Case {
  Cell cell = gantry_cell();
  Random random;
  Landscape land;
  GantryProgram program;

  explicit Case(std::uint64_t seed)
      : random(seed), land(random_landscape(n, random)), program(carve_landscape(cell, land)) {}

  std::size_t pick(std::size_t size) { return static_cast<std::size_t>(random.next() % size); }
  std::size_t pick_keyframe(bool cut) {
    for (;;) {
      const std::size_t at = pick(program.keyframes.size());
      if (program.keyframes[at].cut == cut) return at;
    }
  }
  Verdict verdict() const { return verify_text(program.text(), cell, land.voxels); }
};

TEST(FaultInjection, ACutOffByATenthOfAVoxelIsFound) {
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Case test(seed);
    Vec3 aside(test.random.between(-1, 1), test.random.between(-1, 1), test.random.between(-1, 1));
    aside *= 0.1 * test.program.voxel_m() / aside.norm();
    Keyframe& keyframe = test.program.keyframes[test.pick_keyframe(true)];
    keyframe.q = rounded(keyframe.q + aside);
    EXPECT_FALSE(test.verdict().clean);
  }
}

TEST(FaultInjection, TwoRowsSwappedAreFound) {
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Case test(seed);
    const std::size_t a = test.pick_keyframe(true);
    std::size_t b = a;
    while (b == a) b = test.pick_keyframe(true);
    std::swap(test.program.keyframes[a], test.program.keyframes[b]);
    EXPECT_FALSE(test.verdict().clean);
  }
}

// Does the carving hit something, by sampling every motion densely? Positive: by how much it stays clear of all
// material.
double min_gap(const std::vector<Keyframe>& keyframes, const Configuration& home, double voxel_m, VoxelSet standing) {
  double least = 1;
  Configuration from = home;
  for (const Keyframe& keyframe : keyframes) {
    const int parts = std::max(1, run_length(keyframe)), samples = 40 * parts;
    const Voxel run = keyframe.last - keyframe.first;
    for (int s = 1; s <= samples; ++s) {
      if (keyframe.cut && s % 40 == 1) {
        const int part = (s - 1) / 40;
        standing.erase(parts == 1 ? keyframe.first
                                  : keyframe.first +
                                        Voxel{run.i / (parts - 1), run.j / (parts - 1), run.k / (parts - 1)} * part);
      }
      const Vec3 at = (from + (keyframe.q - from) * s / samples) / voxel_m;
      least = std::min(least, min_upright_gap(at, standing));
    }
    from = keyframe.q;
  }
  return least;
}

TEST(FaultInjection, ADroppedTransitIsFoundExactlyWhenItHits) {
  int hits = 0;
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Case test(seed);
    test.program.keyframes.erase(test.program.keyframes.begin() +
                                 static_cast<std::ptrdiff_t>(test.pick_keyframe(false)));
    const auto& keyframes = test.program.keyframes;
    const Verdict verdict = test.verdict();
    const bool home = keyframes.back().q == test.program.header().home;
    const double least = min_gap(keyframes, test.program.header().home, test.program.voxel_m(), test.land.voxels.stock);
    if (least < -0.01 || !home) {
      EXPECT_FALSE(verdict.clean) << least;
    }
    // A cut that starts elsewhere misses its voxels even where it hits nothing.
    if (least > 0.01 && !found(verdict, {"that it removes"}) && home) {
      EXPECT_TRUE(verdict.clean) << least << "\n" << sentences(verdict);
    }
    hits += least < -0.01;
  }
  EXPECT_GT(hits, runs / 4);
}

TEST(FaultInjection, AMoveToARandomPlaceIsFoundExactlyWhenItHits) {
  int hits = 0;
  for (std::uint64_t seed = 0; seed < 2 * runs; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Case test(seed);
    // Only where the tool is above: between two columns.
    const std::size_t at = 3 * test.pick(60);
    const Vec3 place(test.random.between(-1, n + 1), test.random.between(-1, n + 1), test.random.between(n - 4, n + 1));
    test.program.keyframes.insert(test.program.keyframes.begin() + static_cast<std::ptrdiff_t>(at),
                                  {test.program.q(place), false, {}, {}});
    const Verdict verdict = test.verdict();
    const double least =
        min_gap(test.program.keyframes, test.program.header().home, test.program.voxel_m(), test.land.voxels.stock);
    if (least < -0.01) {
      EXPECT_FALSE(verdict.clean) << least;
    }
    if (least > 0.01) {
      EXPECT_TRUE(verdict.clean) << least << "\n" << sentences(verdict);
    }
    hits += least < -0.01;
  }
  EXPECT_GT(hits, runs / 4);
  EXPECT_LT(hits, 2 * runs);
}

TEST(FaultInjection, AKeepVoxelCutIsFound) {
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Case test(seed);
    Keyframe& keyframe = test.program.keyframes[test.pick_keyframe(true)];
    --keyframe.last.k;  // a run through the topmost keep voxel
    keyframe.q[2] -= test.program.voxel_m();
    const Verdict verdict = test.verdict();
    EXPECT_TRUE(found(verdict, {"belongs to the target"})) << sentences(verdict);
    EXPECT_FALSE(verdict.left.contains(keyframe.last));
  }
}

TEST(FaultInjection, AKeepVoxelThatAMoveRunsThroughIsFound) {
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Case test(seed);
    const std::size_t at = test.pick_keyframe(true);
    Keyframe deeper = test.program.keyframes[at];
    deeper.cut = false;
    deeper.q[2] -= 0.1 * test.program.voxel_m();
    test.program.keyframes.insert(test.program.keyframes.begin() + static_cast<std::ptrdiff_t>(at) + 1, deeper);
    EXPECT_TRUE(found(test.verdict(), {"ball", "material"}));
  }
}

TEST(FaultInjection, AVoxelCutTwiceIsFound) {
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Case test(seed);
    const std::size_t at = test.pick_keyframe(true);
    const std::vector<Keyframe> unit(test.program.keyframes.begin() + static_cast<std::ptrdiff_t>(at) - 1,
                                     test.program.keyframes.begin() + static_cast<std::ptrdiff_t>(at) + 2);
    test.program.keyframes.insert(test.program.keyframes.begin() + static_cast<std::ptrdiff_t>(at) + 2, unit.begin(),
                                  unit.end());
    EXPECT_TRUE(found(test.verdict(), {"second time"}));
  }
}

TEST(FaultInjection, AirThatIsCutIsFound) {
  Case test(1);
  test.land.voxels.stock.erase({4, 4, 7});
  EXPECT_TRUE(found(test.verdict(), {"(4, 4, 7)", "was air"}));
}

TEST(FaultInjection, AVoxelClaimedButNotVisitedIsFound) {
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Case test(seed);
    Keyframe& keyframe = test.program.keyframes[test.pick_keyframe(true)];
    keyframe.q[2] += test.program.voxel_m();  // the run ends a voxel early
    EXPECT_TRUE(found(test.verdict(), {"from the centre of voxel"}));
  }
}

TEST(FaultInjection, ABrokenJointLimitIsFound) {
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Case test(seed);
    Keyframe over = test.program.keyframes[2];
    const auto joint = static_cast<Eigen::Index>(test.pick(3));
    const Joint& limits = test.cell.robot.joints[static_cast<std::size_t>(joint)];
    over.q[joint] = test.pick(2) == 0 ? limits.lower - 1e-6 : limits.upper + (test.pick(2) == 0 ? 1e-6 : 1e300);
    test.program.keyframes.insert(test.program.keyframes.begin() + 3, over);
    EXPECT_TRUE(found(test.verdict(), {"joint " + limits.name, "outside its limits"}));
  }
}

TEST(FaultInjection, APlanThatDoesNotReturnHomeIsFound) {
  Case test(2);
  test.program.keyframes.pop_back();
  EXPECT_TRUE(found(test.verdict(), {"not home"}));
}

TEST(FaultInjection, AWholeUnitLeftOutIsNoCollisionButLeavesItsVoxels) {
  Case test(3);
  test.program.keyframes.erase(test.program.keyframes.begin() + 30, test.program.keyframes.begin() + 33);
  const Verdict verdict = test.verdict();
  EXPECT_TRUE(verdict.clean) << sentences(verdict);
  EXPECT_GT(verdict.left.size(), test.land.voxels.keep.size());
}

}  // namespace
}  // namespace sculpt
