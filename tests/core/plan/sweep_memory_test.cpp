// A sweep goes on from any of its places as if it had never stopped.
#include "core/sweep/sweep_memory.hpp"

#include <gtest/gtest.h>

#include "core/plan/checkpoint/checkpoint.hpp"
#include "core/sweep/sweep.hpp"
#include "core/trajectory/quantum.hpp"
#include "tests/core/plan/jobs.hpp"
#include "tests/core/plan/sweep_targets.hpp"

namespace sculpt {
namespace {

struct Place {
  SweepMemory memory;
  std::size_t keyframes;  ///< until there
  std::uint64_t checks;   ///< since the fields were found
};

struct Sweeping {
  std::vector<Keyframe> keyframes;
  std::vector<Place> places;
  SweepRest rest;
  std::uint64_t checks = 0;  ///< since the fields were found
};

std::string text(const Place& place) {
  Checkpoint checkpoint;
  checkpoint.sweeping = place.memory;
  return checkpoint_text(checkpoint, "key", 0);
}

/// One target and an arm.
class SweepRuns {
 public:
  SweepRuns(const char* cell, const VoxelSet& keep, std::uint64_t seed)
      : cell_(parse_cell(shipped_cell_files(cell))),
        voxels_{VoxelSet(keep.n(), true), keep},
        may_fall_(find_unheld(voxels_)),
        seed_(seed) {}

  Sweeping run(int threads, const std::optional<SweepStart>& start = {}) const {
    const Scene scene(cell_, cell_.grid(voxels_.n()), voxels_.stock);
    Sweeping run;
    std::uint64_t checks_before = 0;
    const SweepListener listener{[&](const std::vector<Keyframe>& batch) {
                                   run.keyframes.insert(run.keyframes.end(), batch.begin(), batch.end());
                                 },
                                 [&] { checks_before = scene.checks(); },
                                 [&](const SweepMemory& memory) {
                                   run.places.push_back({memory, run.keyframes.size(), scene.checks() - checks_before});
                                 }};
    run.rest = carve_by_sweeps(scene, {voxels_, may_fall_, home(scene)}, start, listener, {seed_, threads, {}});
    run.checks = scene.checks() - checks_before;
    return run;
  }

  /// As a checkpoint file and the trajectory give it back.
  SweepStart start_at(const Place& place, const std::vector<Keyframe>& keyframes) const {
    const auto read = read_checkpoint(text(place), "key");
    SweepStart start{*read->checkpoint.sweeping, voxels_.stock, {}};
    for (std::size_t at = 0; at < place.keyframes; ++at) {
      start.q = keyframes[at].q;
      if (keyframes[at].cut) start.standing.erase(keyframes[at].first, keyframes[at].last);
    }
    return start;
  }

 private:
  Configuration home(const Scene& scene) const {
    return rounded(cell_.home(scene.chain()), scene.chain().lower(), scene.chain().upper());
  }

  Cell cell_;
  VoxelGrid voxels_;
  VoxelSet may_fall_;
  std::uint64_t seed_;
};

bool are_same(const Keyframe& a, const Keyframe& b) {
  return a.q == b.q && a.cut == b.cut && (!a.cut || (a.first == b.first && a.last == b.last));
}

/// A box that is open along three of its edges, for tools that lean in different ways.
VoxelSet box_with_gaps(int n, std::uint64_t seed) {
  VoxelSet box = split_box(n, seed);
  for (std::uint64_t edge = 1; edge < 3; ++edge) {
    const VoxelSet other = split_box(n, seed + edge);
    for (std::size_t word = 0; word < box.words().size(); ++word) box.words()[word] &= other.words()[word];
  }
  return box;
}

/// Four walls and a floor: what is in it can be cut from above only.
VoxelSet open_box(int n) {
  VoxelSet box(n, true);
  for_each_voxel(VoxelSet(n, true), [&](Voxel v) {
    if (v.k > 0 && std::min(v.i, v.j) > 0 && std::max(v.i, v.j) < n - 1) box.erase(v);
  });
  return box;
}

VoxelSet target(std::uint64_t seed) {
  switch (seed % 3) {
    case 0:
      return random_target(seed == 0 ? 32 : 16, seed);
    case 1:
      return box_with_gaps(16, seed);
    default:
      return riddled_target(16, seed);
  }
}

/// Which kinds of places were tried.
struct Seen {
  int in_passes = 0, after_passes = 0, with_given_up = 0, with_held = 0, between_tilted = 0, opened = 0;

  void add(const SweepMemory& memory, const SweepMemory* next) {
    ++(memory.pass ? in_passes : after_passes);
    opened += !memory.openings.empty();
    with_given_up += memory.pass && !memory.pass->given_up.empty();
    with_held += memory.pass && !memory.pass->held_here.empty();
    between_tilted += memory.cut_tilted && next != nullptr && next->tilted_fields != memory.tilted_fields;
  }
};

TEST(SweepMemory, HoldsAllThatTheNextDecisionDependsOn) {
  Seen seen;
  for (std::uint64_t seed = 0; seed < 7; ++seed) {
    // With a short tool links come to where the stock was.
    const bool is_short = seed >= 6;
    const SweepRuns runs(is_short ? "panda-turntable-6mm" : "panda-turntable", is_short ? open_box(16) : target(seed),
                         seed);
    const Sweeping whole = runs.run(1);
    ASSERT_FALSE(whole.places.empty());
    // There each run takes seconds.
    const std::size_t step = is_short ? whole.places.size() / 3 : 1;
    for (std::size_t at = is_short ? step : 0; at < whole.places.size(); at += step) {
      const Place& place = whole.places[at];
      SCOPED_TRACE("seed " + std::to_string(seed) + ", place " + std::to_string(at));
      seen.add(place.memory, at + 1 < whole.places.size() ? &whole.places[at + 1].memory : nullptr);
      const Sweeping rest = runs.run(1 + static_cast<int>(at % 2), runs.start_at(place, whole.keyframes));
      EXPECT_TRUE(std::equal(rest.keyframes.begin(), rest.keyframes.end(),
                             whole.keyframes.begin() + static_cast<std::ptrdiff_t>(place.keyframes),
                             whole.keyframes.end(), are_same));
      EXPECT_EQ(rest.rest.standing, whole.rest.standing);
      EXPECT_EQ(rest.rest.out_of_tool_reach, whole.rest.out_of_tool_reach);
      EXPECT_EQ(rest.rest.figures.cut, whole.rest.figures.cut);
      EXPECT_EQ(rest.rest.figures.left, whole.rest.figures.left);
      EXPECT_EQ(rest.rest.figures.uncovered, whole.rest.figures.uncovered);
      EXPECT_EQ(place.checks + rest.checks, whole.checks);
      ASSERT_EQ(rest.places.size(), whole.places.size() - at - 1);
      if (rest.places.empty()) continue;
      EXPECT_EQ(text(rest.places.front()), text(whole.places[at + 1]));
      EXPECT_EQ(text(rest.places.back()), text(whole.places.back()));
    }
  }
  EXPECT_GT(seen.in_passes, 0);
  EXPECT_GT(seen.after_passes, 0);
  EXPECT_GT(seen.with_given_up, 0);
  EXPECT_GT(seen.with_held, 0);
  EXPECT_GT(seen.between_tilted, 0);
  EXPECT_GT(seen.opened, 0);
}

}  // namespace
}  // namespace sculpt
