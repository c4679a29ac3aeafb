// Several workers, pieces of a trajectory: what is said must not depend on who replays what.
#include <gtest/gtest.h>

#include <mutex>
#include <set>
#include <thread>

#include "core/trajectory/quantum.hpp"
#include "core/verify/trajectory_pieces.hpp"
#include "tests/core/verify/small_cells.hpp"

namespace sculpt {
namespace {

constexpr int n = 16;

// The landscape's plan, and then up and down above it until it fills several pieces.
GantryProgram long_program(const Cell& cell, const Landscape& land, std::size_t keyframes) {
  GantryProgram program = carve_landscape(cell, land);
  program.keyframes.pop_back();
  while (program.keyframes.size() < keyframes) {
    const auto at = static_cast<double>(program.keyframes.size() % 7);
    program.move(Vec3(at, 8, n + 1));
  }
  program.go_home();
  return program;
}

Verdict verdict_of(const std::string& text, const Cell& cell, const VoxelGrid& voxels, int threads,
                   std::function<bool()> alone = {}) {
  std::istringstream in(text);
  return verify_trajectory(in, cell, voxels, {}, {threads, false, std::move(alone)});
}

void expect_same(const Verdict& a, const Verdict& b) {
  EXPECT_EQ(a.clean, b.clean);
  EXPECT_EQ(a.collisions, b.collisions);
  EXPECT_EQ(a.voxels_checked, b.voxels_checked);
  EXPECT_EQ(a.left, b.left);
  EXPECT_EQ(sentences(a), sentences(b));
}

TEST(Threads, TheVerdictIsTheSameAtAnyNumber) {
  const Cell cell = gantry_cell();
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Landscape land = random_landscape(n, random);
    GantryProgram program = long_program(cell, land, 4500);
    const bool faulty = seed % 4 != 0;
    for (int fault = 0; faulty && fault < 40; ++fault) {
      // Up to the last piece: cuts off their place, moves through what stands.
      Keyframe& keyframe = program.keyframes[static_cast<std::size_t>(random.next() % program.keyframes.size())];
      const double size = keyframe.cut ? 0.2 : 4;
      keyframe.q[2] -= size * program.voxel_m();
      keyframe.q = rounded(keyframe.q);
    }
    const std::string text = program.text();
    const Verdict alone = verdict_of(text, cell, land.voxels, 1);
    EXPECT_EQ(alone.clean, !faulty) << sentences(alone);
    for (int threads : {2, 3, 7}) {
      SCOPED_TRACE(std::to_string(threads) + " threads");
      expect_same(alone, verdict_of(text, cell, land.voxels, threads));
      // The others come late, or not at all.
      for (int asked_last : {1, 3, 100})
        expect_same(alone, verdict_of(text, cell, land.voxels, threads,
                                      [asked = 0, asked_last]() mutable { return ++asked < asked_last; }));
    }
  }
}

TEST(Threads, MoreThanThereArePiecesAreNoHarm) {
  const Cell cell = gantry_cell();
  Random random(1);
  const Landscape land = random_landscape(4, random);
  const std::string text = carve_landscape(cell, land).text();
  expect_same(verdict_of(text, cell, land.voxels, 1), verdict_of(text, cell, land.voxels, 9));
  expect_same(verdict_of(GantryProgram(cell, 4).text(), cell, land.voxels, 1),
              verdict_of(GantryProgram(cell, 4).text(), cell, land.voxels, 9));
}

TEST(Threads, BrokenTextAndAStopEndAllOfThem) {
  const Cell cell = gantry_cell();
  Random random(2);
  const Landscape land = random_landscape(n, random);
  const std::string text = long_program(cell, land, 6000).text();
  for (const std::size_t length : {text.size() / 3, text.size() / 2, text.size() - 2}) {
    const std::string cut_short = text.substr(0, length);
    EXPECT_THROW(verdict_of(cut_short, cell, land.voxels, 4), InputError);
  }
  // How much of the work the calling thread gets is not known, so neither is when it would tell for the 50th time.
  for (const auto& [threads, told_last] : {std::pair{3, 0}, {1, 1}, {1, 50}, {1, 900}}) {
    SCOPED_TRACE(std::to_string(threads) + " threads, stop at " + std::to_string(told_last));
    std::stop_source source;
    if (told_last == 0) source.request_stop();
    int told = 0;
    const std::thread::id caller = std::this_thread::get_id();
    const Watch watch{source.get_token(), [&](const Progress& progress) {
                        EXPECT_EQ(std::this_thread::get_id(), caller);
                        EXPECT_LE(progress.done, progress.total);
                        if (++told == told_last) source.request_stop();
                      }};
    std::istringstream in(text);
    EXPECT_THROW(verify_trajectory(in, cell, land.voxels, watch, {threads}), Cancelled);
    EXPECT_EQ(told, told_last);
  }
}

TEST(TrajectoryPieces, EveryWorkerSeesEveryPieceOnceAndInOrder) {
  const Cell cell = gantry_cell();
  GantryProgram program(cell, 8);
  constexpr std::size_t pieces = 150;
  for (std::size_t at = 0; at < pieces * TrajectoryPieces::keyframes_a_piece - 5; ++at)
    program.move(Vec3(static_cast<double>(at % 5), 4, 9));
  program.go_home();
  std::istringstream in(program.text());
  TrajectoryReader reader(in);
  constexpr std::size_t workers = 3;
  TrajectoryPieces source(reader);
  source.join(workers - 1);
  std::vector<std::vector<std::size_t>> seen(workers);
  std::mutex mutex;
  std::set<std::size_t> own;
  const auto work = [&](std::size_t worker) {
    std::vector<TrajectoryPieces::Piece> before;
    for (;;) {
      const TrajectoryPieces::Piece piece = source.next(worker, before, [] {});
      for (const auto& missed : before) seen[worker].push_back(missed->index);
      if (!piece) return;
      seen[worker].push_back(piece->index);
      EXPECT_EQ(piece->first_line, 2 + piece->index * TrajectoryPieces::keyframes_a_piece);
      const std::lock_guard lock(mutex);
      EXPECT_TRUE(own.insert(piece->index).second);
    }
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t worker = 0; worker < workers; ++worker) threads.emplace_back(work, worker);
  }
  EXPECT_EQ(own.size(), pieces);
  for (const auto& indices : seen) {
    ASSERT_EQ(indices.size(), pieces);
    for (std::size_t at = 0; at < pieces; ++at) EXPECT_EQ(indices[at], at);
  }
  EXPECT_EQ(source.end(), program.header().home);
}

TEST(TrajectoryPieces, WhoJoinsLateSeesWhatComesAfter) {
  const Cell cell = gantry_cell();
  GantryProgram program(cell, 8);
  for (std::size_t at = 0; at < 5 * TrajectoryPieces::keyframes_a_piece - 5; ++at)
    program.move(Vec3(static_cast<double>(at % 5), 4, 9));
  program.go_home();
  std::istringstream in(program.text());
  TrajectoryReader reader(in);
  TrajectoryPieces source(reader);
  std::vector<TrajectoryPieces::Piece> before;
  for (std::size_t at = 0; at < 2; ++at) EXPECT_EQ(source.next(0, before, [] {})->index, at);
  source.join(1);
  constexpr std::size_t late = 1;
  EXPECT_EQ(source.next(0, before, [] {})->index, 2u);
  EXPECT_EQ(source.next(late, before, [] {})->index, 3u);
  ASSERT_EQ(before.size(), 1u);
  EXPECT_EQ(before.front()->index, 2u);
  EXPECT_EQ(source.next(0, before, [] {})->index, 4u);
  ASSERT_EQ(before.size(), 1u);
  EXPECT_EQ(before.front()->index, 3u);
}

}  // namespace
}  // namespace sculpt
