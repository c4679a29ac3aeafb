// A replay that follows a file while it is written says what one of the whole file says; what it finds it tells at
// once.
#include "core/plan/replay_beside.hpp"

#include <gtest/gtest.h>

#include <future>

#include "tests/core/plan/jobs.hpp"
#include "tests/core/verify/small_cells.hpp"

namespace sculpt {
namespace {

constexpr int n = 16;

struct Example {
  Cell cell = gantry_cell();
  Landscape land;
  std::string text;

  /// The plan of a landscape, then up and down above it; with `fault` a keyframe early on goes through what stands.
  explicit Example(std::uint64_t seed, bool fault) {
    Random random(seed);
    land = random_landscape(n, random);
    GantryProgram program = carve_landscape(cell, land);
    program.keyframes.pop_back();
    while (program.keyframes.size() < 6000)
      program.move(Vec3(static_cast<double>(program.keyframes.size() % 7), 8, n + 1));
    program.go_home();
    if (fault) {
      Keyframe& keyframe = program.keyframes[300];
      keyframe.q[2] -= 3 * program.voxel_m();
      keyframe.q = rounded(keyframe.q);
    }
    text = program.text();
  }
};

Verdict follow(const Example& example, int threads, std::size_t bytes_at_once, int& alarms) {
  const ScratchFile file;
  std::atomic<int> rung = 0;
  ReplayBeside replay({file.path(), example.cell, example.land.voxels, threads}, {}, [&rung] { ++rung; });
  std::ofstream out(file.path(), std::ios::binary);
  for (std::size_t at = 0; at < example.text.size(); at += bytes_at_once) {
    out << example.text.substr(at, bytes_at_once) << std::flush;
    replay.grow();
  }
  replay.end();
  Verdict verdict = replay.wait({}, [] {});
  alarms = rung;
  return verdict;
}

TEST(ReplayBeside, SaysWhatAReplayOfTheWholeFileSays) {
  for (const bool fault : {false, true})
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const Example example(seed, fault);
      const Verdict whole = verify_text(example.text, example.cell, example.land.voxels);
      EXPECT_EQ(whole.clean, !fault);
      for (const int threads : {1, 2, 4})
        for (const std::size_t bytes : {1000, 70'000, 10'000'000}) {
          SCOPED_TRACE("seed " + std::to_string(seed) + ", " + std::to_string(threads) + " threads, " +
                       std::to_string(bytes) + " bytes at once");
          int alarms = 0;
          const Verdict verdict = follow(example, threads, bytes, alarms);
          EXPECT_EQ(verdict.collisions, whole.collisions);
          EXPECT_EQ(verdict.voxels_checked, whole.voxels_checked);
          EXPECT_EQ(sentences(verdict), sentences(whole));
          EXPECT_EQ(verdict.left, whole.left);
          EXPECT_LE(alarms, fault ? 1 : 0);
        }
    }
}

TEST(ReplayBeside, SoundsTheAlarmWhileThePlanIsStillMade) {
  const Example example(5, true);
  const ScratchFile file;
  std::promise<void> rung;
  ReplayBeside replay({file.path(), example.cell, example.land.voxels, 2}, {}, [&rung] { rung.set_value(); });
  std::ofstream out(file.path(), std::ios::binary);
  out << example.text.substr(0, example.text.size() / 2) << std::flush;
  replay.grow();
  rung.get_future().wait();  // though the file is not whole
  EXPECT_TRUE(replay.alarmed());
  EXPECT_GT(replay.replayed().found.collisions, 0u);
}

TEST(ReplayBeside, GoesOnWhereAnotherOneWas) {
  const Example example(6, true);
  const ScratchFile file;
  std::ofstream(file.path(), std::ios::binary) << example.text;
  const Verdict whole = verify_text(example.text, example.cell, example.land.voxels);
  std::vector<ReplayedPieces> notes;
  std::istringstream in(example.text);
  verify_trajectory(in, example.cell, example.land.voxels, {}, {}, {},
                    [&](const ReplayedPieces& replayed) { notes.push_back(replayed); });
  ASSERT_GT(notes.size(), 3u);
  for (const ReplayedPieces& note : notes)
    for (const int threads : {1, 3}) {
      ReplayBeside replay({file.path(), example.cell, example.land.voxels, threads}, note, [] {});
      replay.grow();
      replay.end();
      EXPECT_EQ(sentences(replay.wait({}, [] {})), sentences(whole));
      EXPECT_EQ(replay.replayed().pieces, notes.back().pieces);
    }
}

TEST(ReplayBeside, OfATrajectoryThatIsNoneFailsAndSaysSo) {
  const Example example(7, false);
  for (const int threads : {1, 2}) {
    const ScratchFile file;
    ReplayBeside replay({file.path(), example.cell, example.land.voxels, threads}, {}, [] {});
    std::ofstream(file.path(), std::ios::binary) << example.text.substr(0, example.text.size() / 2);
    replay.grow();
    replay.end();
    EXPECT_THROW(replay.wait({}, [] {}), InputError);
  }
}

TEST(ReplayBeside, IsGivenUpAtAnyMoment) {
  const Example example(8, false);
  for (std::size_t parts = 0; parts < 8; ++parts) {
    const ScratchFile file;
    ReplayBeside replay({file.path(), example.cell, example.land.voxels, 3}, {}, [] {});
    if (parts == 0) continue;
    std::ofstream(file.path(), std::ios::binary) << example.text.substr(0, parts * example.text.size() / 8);
    replay.grow();
    if (parts % 2 == 0) std::this_thread::yield();
  }
}

TEST(ReplayBeside, AStopEndsTheWait) {
  const Example example(9, false);
  const ScratchFile file;
  ReplayBeside replay({file.path(), example.cell, example.land.voxels, 2}, {}, [] {});
  std::stop_source stop;
  const Watch watch{stop.get_token(), {}};
  std::ofstream(file.path(), std::ios::binary) << example.text.substr(0, example.text.size() / 2);
  replay.grow();  // and never whole
  EXPECT_THROW(replay.wait(watch, [&stop] { stop.request_stop(); }), Cancelled);
}

}  // namespace
}  // namespace sculpt
