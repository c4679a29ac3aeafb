// Random plans with one random thing broken, against a plain dense sampling that shares nothing with the replay: found
// exactly when it does harm.
#include <gtest/gtest.h>

#include <array>
#include <map>

#include "core/trajectory/header.hpp"
#include "core/trajectory/keyframe.hpp"
#include "core/trajectory/quantum.hpp"
#include "tests/core/verify/small_cells.hpp"

namespace sculpt {
namespace {

constexpr int n = 8;

enum class Fault { keyframe_off, rows_swapped, move_dropped, voxels_shifted, keyframe_doubled, keyframe_dropped };
constexpr std::array all_faults{Fault::keyframe_off,   Fault::rows_swapped,     Fault::move_dropped,
                                Fault::voxels_shifted, Fault::keyframe_doubled, Fault::keyframe_dropped};

// Layer by layer from above, in rows to and fro along x; long runs, unlike plunges.
GantryProgram carve_in_layers(const Cell& cell, const Landscape& land) {
  GantryProgram program(cell, n);
  const auto to_go = [&](int i, int j, int k) {
    return i >= 0 && i < n && land.height[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] <= k;
  };
  for (int k = n - 1; k > 0; --k)
    for (int j = 0; j < n; ++j) {
      const int way = j % 2 == 0 ? 1 : -1;
      for (int i = way > 0 ? 0 : n - 1; i >= 0 && i < n; i += way) {
        if (!to_go(i, j, k)) continue;
        program.move(Vec3(i + 0.5, j + 0.5, n + 0.5));
        program.move(Vec3(i + 0.5, j + 0.5, k + 1.5));
        program.cut({i, j, k}, {i, j, k});
        int last = i;
        while (to_go(last + way, j, k)) last += way;
        if (last != i) program.cut({i + way, j, k}, {last, j, k});
        i = last;
        program.move(Vec3(i + 0.5, j + 0.5, n + 0.5));
      }
    }
  program.go_home();
  return program;
}

struct Harm {
  double min_gap = 1;  // of tool and material, in voxels
  bool wrong = false;  // a voxel that was not there, missed or kept; not home
};

Harm sample(const GantryProgram& program, const TrajectoryHeader& header, const VoxelGrid& voxels) {
  Harm harm;
  VoxelSet standing = voxels.stock;
  Configuration from = header.home;
  for (const Keyframe& keyframe : program.keyframes) {
    const int parts = std::max(1, run_length(keyframe));
    const Voxel run = keyframe.last - keyframe.first;
    for (int part = 0; part < parts; ++part) {
      if (keyframe.cut) {
        const Voxel voxel =
            parts == 1 ? keyframe.first
                       : keyframe.first + Voxel{run.i / (parts - 1), run.j / (parts - 1), run.k / (parts - 1)} * part;
        const Vec3 at = (from + (keyframe.q - from) * (part + 1) / parts) / program.voxel_m();
        const double miss = (at - Vec3(voxel.i + 0.5, voxel.j + 0.5, voxel.k + 0.5)).norm();
        harm.wrong = harm.wrong || miss > 0.021 || voxels.keep.contains(voxel) || !standing.contains(voxel);
        standing.erase(voxel);
      }
      for (int s = 0; s <= 40; ++s) {
        const Vec3 at = (from + (keyframe.q - from) * (part + s / 40.0) / parts) / program.voxel_m();
        harm.min_gap = std::min(harm.min_gap, min_upright_gap(at, standing));
      }
    }
    from = keyframe.q;
  }
  harm.wrong = harm.wrong || from != header.home;
  return harm;
}

struct Breaker {
  Random& random;
  std::vector<Keyframe>& keyframes;

  std::size_t pick(int cut) {  // -1: any
    for (;;) {
      const auto at = static_cast<std::size_t>(random.next() % keyframes.size());
      if (cut < 0 || keyframes[at].cut == (cut == 1)) return at;
    }
  }

  void apply(Fault fault, double voxel_m) {
    const std::size_t at = pick(fault == Fault::move_dropped ? 0 : fault >= Fault::keyframe_doubled ? -1 : 1);
    const auto place = keyframes.begin() + static_cast<std::ptrdiff_t>(at);
    switch (fault) {
      case Fault::keyframe_off:
        place->q = rounded(place->q + 0.1 * voxel_m * direction());
        break;
      case Fault::rows_swapped:
        std::swap(*place, keyframes[pick(1)]);
        break;
      case Fault::voxels_shifted:
        shift(*place);
        break;
      case Fault::keyframe_doubled:
        keyframes.insert(place, Keyframe(*place));
        break;
      case Fault::move_dropped:
      case Fault::keyframe_dropped:
        keyframes.erase(place);
        break;
    }
  }

  Vec3 direction() { return Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)).normalized(); }

  void shift(Keyframe& keyframe) {
    for (;;) {
      const Voxel step = face_steps[static_cast<std::size_t>(random.next() % 6)];
      const Voxel first = keyframe.first + step, last = keyframe.last + step;
      if (!Grid{n}.contains(first) || !Grid{n}.contains(last)) continue;
      keyframe.first = first;
      keyframe.last = last;
      return;
    }
  }
};

TEST(RandomFaults, AreFoundExactlyWhenTheyDoHarm) {
  const Cell cell = gantry_cell();
  std::map<Fault, int> harmful;
  constexpr std::uint64_t seeds = 40;
  for (std::uint64_t seed = 0; seed < seeds; ++seed)
    for (const Fault fault : all_faults) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", fault " + std::to_string(static_cast<int>(fault)));
      Random random(1000 * seed + static_cast<std::uint64_t>(fault));
      const Landscape land = random_landscape(n, random);
      GantryProgram program = seed % 2 == 0 ? carve_in_layers(cell, land) : carve_landscape(cell, land);
      Breaker{random, program.keyframes}.apply(fault, program.voxel_m());
      const Harm harm = sample(program, program.header(), land.voxels);
      std::istringstream in(program.text());
      const Verdict verdict = verify_trajectory(in, cell, land.voxels, {}, {1 + static_cast<int>(seed % 3)});
      if (harm.wrong || harm.min_gap < -0.01) {
        EXPECT_FALSE(verdict.clean) << harm.min_gap;
        ++harmful[fault];
      } else if (harm.min_gap > 0.01) {
        EXPECT_TRUE(verdict.clean) << harm.min_gap << "\n" << sentences(verdict);
      }
    }
  for (const Fault fault : all_faults)
    EXPECT_GT(harmful[fault], static_cast<int>(seeds / 8)) << static_cast<int>(fault);
  for (const Fault fault : {Fault::keyframe_off, Fault::voxels_shifted}) EXPECT_EQ(harmful[fault], seeds);
}

TEST(RandomFaults, AWholePlanInLayersIsClean) {
  const Cell cell = gantry_cell();
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Landscape land = random_landscape(n, random);
    const Verdict verdict = verify_text(carve_in_layers(cell, land).text(), cell, land.voxels);
    EXPECT_TRUE(verdict.clean) << sentences(verdict);
    EXPECT_EQ(verdict.left, land.voxels.keep);
  }
}

}  // namespace
}  // namespace sculpt
