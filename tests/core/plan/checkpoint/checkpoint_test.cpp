// What a checkpoint file says is read back, or refused: never half.
#include "core/plan/checkpoint/checkpoint.hpp"

#include <gtest/gtest.h>

#include "core/plan/job_key.hpp"
#include "tests/core/plan/jobs.hpp"

namespace sculpt {
namespace {

Configuration configuration(double first, double second) {
  Configuration q(2);
  q << first, second;
  return q;
}

/// No field as it is by default.
SweepMemory full_sweep_memory() {
  SweepMemory sweeping{{0, 1, 0}, {1, 1, 0}, {2, 5}, {}, 77, true, true, {{{7, 8, 9}}}, {}, 2, {}};
  VoxelSet blocks(8);
  blocks.insert({7, 1, 3});
  sweeping.openings = {{VoxelSet(8, true), blocks}, {VoxelSet(32, true), VoxelSet(32)}};
  sweeping.arm = {11, {0.1, 1.0 / 3, 65}, {configuration(0.3, -1e-7)}};
  sweeping.pass = StraightMark{5, 8, {{1, 2, 3, 4}}, {{5, 6, 7, 8}, {0, 0, 1, 1}}, true, {true, true}};
  return sweeping;
}

/// No field as it is by default.
MillMemory full_mill_memory() {
  return {{{"D20", 5, 6, 7, 1.0 / 3, 0.1, 0.2, {0.3, 0.4}}, {"a \"D6\"", 0, 3, 0, 0, 0, 1e-9, {}}},
          {{{4, {configuration(1, 2), configuration(0.1, -2.1234567)}}, {17, {}}}, {-1, 3}, 12},
          {0, 1, 1, 0}};
}

/// No field as it is by default.
Checkpoint full_checkpoint() {
  Checkpoint checkpoint;
  checkpoint.file = {7, 900, std::string(64, 'a')};
  checkpoint.checks = std::uint64_t{1} << 63;
  checkpoint.sweeping = full_sweep_memory();
  checkpoint.swept = SweptMark{3, {{1, 2, 3}, {4, 5, 6}}};
  checkpoint.trials = {{5, 3, {0, 1, 2}}, {0, 8, {0, 1, 2}}};
  checkpoint.arm = {4, false, 2, {configuration(0.1, -2.1234567)}, {{3, {configuration(1, 2)}}}, 9, 8, 7};
  checkpoint.residue = {{{1, 1, 1}, Reason::no_transit}, {{2, 1, 1}, Reason::loose_piece}};
  checkpoint.sweep_figures = {900, 20, 3};
  checkpoint.milling = full_mill_memory();
  checkpoint.milled = MilledFigures{{{"D20", 5, 6, 7, 1.0 / 3, 0.1, 0.2, {0.3, 0.4}}},
                                    {{Obstacle::length, 6e-3, 0.061, 0.7, 128}},
                                    {9, 8, 1e-5, 2e-5, 1.0 / 7, 4e-5}};
  checkpoint.replayed = {2, {1, 30, {{12, "'link5' touches \"stock\""}}}};
  return checkpoint;
}

TEST(Checkpoint, IsReadBackAsItWasWritten) {
  for (const Checkpoint& checkpoint : {full_checkpoint(), Checkpoint{}}) {
    const std::string text = checkpoint_text(checkpoint, "key", 5);
    const auto read = read_checkpoint(text, "key");
    ASSERT_TRUE(read);
    EXPECT_EQ(read->number, 5u);
    EXPECT_EQ(checkpoint_text(read->checkpoint, "key", 5), text);
  }
  const std::string text = checkpoint_text(full_checkpoint(), "key", 5);
  const Checkpoint read = read_checkpoint(text, "key")->checkpoint;
  EXPECT_EQ(read.file, full_checkpoint().file);
  EXPECT_EQ(read.swept->out_of_tool_reach, full_checkpoint().swept->out_of_tool_reach);
  EXPECT_EQ(read.sweeping->arm.at, full_sweep_memory().arm.at);
  EXPECT_EQ(read.sweeping->arm.way_home, full_sweep_memory().arm.way_home);
  EXPECT_EQ(read.sweeping->pass->held_here, full_sweep_memory().pass->held_here);
  EXPECT_EQ(read.arm.hubs, full_checkpoint().arm.hubs);
  EXPECT_EQ(read.arm.way_out, full_checkpoint().arm.way_out);
  EXPECT_EQ(read.milling->arm.ways, full_mill_memory().arm.ways);
  EXPECT_EQ(read.milling->arm.searched, full_mill_memory().arm.searched);
  EXPECT_EQ(read.milling->reachable, full_mill_memory().reachable);
  EXPECT_EQ(read.milling->tools.front().removed_m3, 1.0 / 3);
  EXPECT_EQ(read.milled->cures.front().obstacle, Obstacle::length);
  EXPECT_EQ(read.milled->reachable.p99_m, 1.0 / 7);
  EXPECT_EQ(read.residue->back().reason, Reason::loose_piece);
  EXPECT_EQ(read.replayed.found.findings.front().sentence, "'link5' touches \"stock\"");
}

TEST(Checkpoint, EveryFlippedBitAndEveryCutIsSeen) {
  const std::string text = checkpoint_text(full_checkpoint(), "key", 5);
  for (std::size_t at = 0; at < text.size(); ++at) {
    EXPECT_FALSE(read_checkpoint(text.substr(0, at), "key")) << "cut at " << at;
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = text;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
      EXPECT_FALSE(read_checkpoint(damaged, "key")) << "byte " << at << ", bit " << bit;
    }
  }
  EXPECT_FALSE(read_checkpoint(text + "x", "key"));
}

TEST(Checkpoint, OfAnotherJobOrProgramIsNotUsed) {
  EXPECT_FALSE(read_checkpoint(checkpoint_text(full_checkpoint(), "key", 5), "other"));
}

TEST(JobKey, DependsOnWhateverThePlanDependsOn) {
  const Job job = make_job(shipped_cell_files("gantry"), random_target(8, 1));
  std::vector<Job> others(10, job);
  others[0].seed = 1;
  others[1].resolution = 16;
  others[2].search = Search::voxel;
  others[3].mesh.bytes.back() ^= 1;
  others[4].cell.cell_json += ' ';
  others[5].cell.files.begin()->second += ' ';
  others[6].placement.scale_m = 0.0;
  others[7].placement.offset_m.z() = 1e-9;
  others[8].stock.box = Stock::Box{Vec3::Zero(), Vec3::Zero()};
  others[9].stock.mesh = MeshFile{};
  for (std::size_t at = 0; at < others.size(); ++at) EXPECT_NE(job_key(others[at]), job_key(job)) << at;
  Job threads = job;
  threads.threads = 2;
  EXPECT_EQ(job_key(threads), job_key(job));
}

}  // namespace
}  // namespace sculpt
