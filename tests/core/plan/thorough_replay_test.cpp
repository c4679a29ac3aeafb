// The replay's short cuts against the same replay where FCL and octomap decide every motion by itself: whole plans of
// arms, gantries and machines that are tight by design, as they are and with faults.
#include <gtest/gtest.h>

#include <sstream>

#include "core/trajectory/quantum.hpp"
#include "core/trajectory/reader.hpp"
#include "core/trajectory/writer.hpp"
#include "core/verify/verify.hpp"
#include "tests/core/plan/jobs.hpp"
#include "tests/core/plan/soundness.hpp"
#include "tests/core/plan/tight_cells.hpp"

namespace sculpt {
namespace {

struct Program {
  TrajectoryHeader header;
  std::vector<Keyframe> keyframes;

  explicit Program(std::istream& in) {
    TrajectoryReader reader(in);
    header = reader.header();
    while (auto keyframe = reader.next()) keyframes.push_back(*keyframe);
  }
  std::string text() const {
    std::ostringstream out;
    TrajectoryWriter writer(out, header);
    for (const Keyframe& keyframe : keyframes) writer.add(keyframe);
    writer.finish();
    return out.str();
  }

  /// A joint value off by little or much, two keyframes in each other's place, or one left out.
  void break_somewhere(Random& random) {
    const auto at = static_cast<std::size_t>(random.next() % (keyframes.size() - 1));
    switch (random.next() % 3) {
      case 0: {
        Configuration& q = keyframes[at].q;
        q[static_cast<Eigen::Index>(random.next() % static_cast<std::uint64_t>(q.size()))] +=
            random.between(-1, 1) * std::pow(10, random.between(-5, 0));
        q = rounded(q);
        break;
      }
      case 1:
        std::swap(keyframes[at], keyframes[at + 1]);
        break;
      default:
        keyframes.erase(keyframes.begin() + static_cast<std::ptrdiff_t>(at));
    }
  }
};

std::string said_of(const std::string& text, const Cell& cell, const VoxelGrid& voxels, ReplaySettings settings) {
  std::istringstream in(text);
  const Verdict verdict = verify_trajectory(in, cell, voxels, {}, settings);
  std::ostringstream said;
  said << (verdict.clean ? "clean" : "not clean") << ", " << verdict.collisions << " findings, "
       << verdict.voxels_checked << " voxels, " << verdict.left.size() << " left, " << verdict.freed << " freed\n";
  for (const Finding& finding : verdict.findings) said << finding.line << ": " << finding.sentence << "\n";
  return said.str();
}

/// How many of the broken plans were found to be so.
int compare(const Job& job, int faulty) {
  const ScratchFile file;
  const JobResult result = run_job(job, file.path(), {});
  expect_sound(result);
  std::ifstream in(file.path(), std::ios::binary);
  const Program whole(in);
  const Cell cell = parse_cell(job.cell);
  Random random(job.seed);
  int found = 0;
  if (whole.keyframes.size() < 20) faulty = 0;  // nothing much is reached
  for (int trial = 0; trial <= faulty; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    Program program = whole;
    const int faults = trial == 0 ? 0 : trial % 3 == 0 ? 3 : 1;
    for (int fault = 0; fault < faults; ++fault) program.break_somewhere(random);
    const std::string text = program.text();
    const std::string fast = said_of(text, cell, result.voxels, {2, false});
    EXPECT_EQ(fast, said_of(text, cell, result.voxels, {2, true}));
    if (trial == 0) {
      EXPECT_EQ(fast.find("clean"), 0u) << fast;
    }
    found += fast.find("not clean") == 0;
  }
  return found;
}

Job job_for(CellFiles cell, int n, std::uint64_t seed, Search search) {
  Job job = make_job(cell, random_target(n, seed), seed);
  job.search = search;
  return job;
}

TEST(ThoroughReplay, SaysTheSameOfArms) {
  int found = 0;
  for (const char* cell : {"panda-turntable", "panda-turntable-6mm"})
    for (std::uint64_t seed = 0; seed < 2; ++seed) {
      SCOPED_TRACE(std::string(cell) + ", seed " + std::to_string(seed));
      found += compare(job_for(shipped_cell_files(cell), 8, seed, Search::sweep), 6);
    }
  EXPECT_GT(found, 8);
}

TEST(ThoroughReplay, SaysTheSameOfGantries) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    found += compare(job_for(shipped_cell_files("gantry"), 16, seed, Search::octree), 8);
    found += compare(job_for(clamped_gantry(), 16, seed, Search::octree), 8);
  }
  EXPECT_GT(found, 20);
}

TEST(ThoroughReplay, SaysTheSameOfTightMachines) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const TightMachine machine = random_tight_machine(seed, 8);
    SCOPED_TRACE(machine.title);
    Job job = make_job(machine.files(), random_target(8, seed), seed);
    found += compare(job, 5);
  }
  EXPECT_GT(found, 10);
}

class SharedMeshes : public testing::TestWithParam<const char*> {};

TEST_P(SharedMeshes, AreReplayedThoroughlyWithTheSameWords) {
  const auto path = shared_data() / "cells" / (std::string(GetParam()) + ".json");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "shared data folder without cells/" << GetParam() << ".json";
  EXPECT_GT(compare(job_for(read_cell_files(path), 8, 3, Search::sweep), 6), 1);
}
INSTANTIATE_TEST_SUITE_P(ThoroughReplay, SharedMeshes, testing::Values("kr16", "kr120"));

}  // namespace
}  // namespace sculpt
