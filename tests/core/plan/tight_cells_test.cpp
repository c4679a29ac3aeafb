// Plans for machines whose parts move close to each other. SCULPT_TIGHT_CELLS=N tries N of them, from seed
// SCULPT_TIGHT_FROM on.
#include "tests/core/plan/tight_cells.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/core/plan/jobs.hpp"

namespace sculpt {
namespace {

constexpr int resolution = 8;

/// The issue's gantry: a ram of 40 mm in a hole of 160 mm of a fixed plate, on axes of +-2 m, over a stock that it
/// cannot reach all of without going through the plate.
TightMachine ram_in_plate(double stock_m, bool turning_head) {
  using Move = MachinePart::Move;
  TightMachine machine;
  machine.stock_m = stock_m;
  machine.tool_radius_m = 0.45 * stock_m / resolution;
  const double nose = 0.25 + stock_m;
  machine.parts = {{"room", -1},
                   {"bridge", 0, Move::slide, {0, 0, nose}, false, Vec3::UnitX(), -2, 2},
                   {"carriage", 1, Move::slide, Vec3::Zero(), false, Vec3::UnitY(), -2, 2},
                   {"ram", 2, Move::slide, Vec3::Zero(), true, Vec3::UnitZ(), -0.05, 0.5}};
  for (double side : {-1.0, 1.0}) {
    machine.parts[0].bricks.push_back({{side * 1.58, 0, nose + 0.06}, {1.5, 3.08, 0.015}});
    machine.parts[0].bricks.push_back({{0, side * 1.58, nose + 0.06}, {0.08, 1.5, 0.015}});
  }
  machine.parts[3].bricks = {{{0, 0, -0.75}, {0.02, 0.02, 0.75}}};
  if (turning_head) machine.parts.push_back({"head", 3, Move::hinge, {0, 0, 0.005}, false, Vec3::UnitZ(), -1.5, 1.5});
  return machine;
}

struct Outcome {
  std::optional<JobResult> result;  ///< none: refused
  std::string trajectory, refusal;
};

Outcome plan(const TightMachine& machine, const VoxelSet& target, const std::string& search) {
  const ScratchFile file;
  Outcome outcome;
  try {
    Job job = make_job(machine.files(), target);
    job.search = parse_search(search);
    outcome.result = run_job(job, file.path(), {});
    outcome.trajectory = read_file(file.path());
  } catch (const InputError& error) {
    outcome.refusal = error.code() + ": " + error.what();
  }
  return outcome;
}

void expect_good(const TightMachine& machine, const Outcome& outcome) {
  const Report& report = outcome.result->report;
  EXPECT_TRUE(report.verify.clean) << (report.findings.empty() ? "" : report.findings.front());
  EXPECT_EQ(report.voxels.removed + report.voxels.residue, report.voxels.remove);
  EXPECT_EQ(find_overlap(machine, outcome.trajectory), "");
}

TEST(TightCells, ARamNeverGoesThroughThePlateThatItPassesThrough) {
  VoxelSet target(resolution);
  target.insert({4, 4, 0});
  const TightMachine small = ram_in_plate(0.1, false);
  const Outcome planned = plan(small, target, "octree");
  ASSERT_TRUE(planned.result) << planned.refusal;
  expect_good(small, planned);
  EXPECT_GT(planned.result->report.voxels.removed, planned.result->report.voxels.residue);

  const TightMachine large = ram_in_plate(0.2, true);
  const Outcome part = plan(large, target, "octree");
  ASSERT_TRUE(part.result) << part.refusal;
  expect_good(large, part);
  EXPECT_GT(part.result->report.voxels.removed, 0u);
  EXPECT_GT(part.result->report.voxels.residue, 0u) << "the outer voxels cannot be had without the plate";
}

TEST(TightCells, TheCheckSeesARamInThePlate) {
  const TightMachine machine = ram_in_plate(0.1, false);
  const std::string header = R"({"type":"header","joints":["j_bridge","j_carriage","j_ram"]})";
  const auto moves_to = [&](const std::string& q) {
    return find_overlap(machine, header + "\n{\"type\":\"move\",\"q\":" + q + "}\n");
  };
  EXPECT_EQ(moves_to("[0.059,0.059,0]"), "");
  EXPECT_NE(moves_to("[0.061,0,0]"), "");
  EXPECT_NE(moves_to("[-2,0,0]"), "");
  EXPECT_EQ(moves_to("[0,0,0.2]"), "");
}

Outcome plan_seed(const TightMachine& machine, std::uint64_t seed) {
  return plan(machine, on_the_floor(random_target(resolution, seed)), seed % 2 == 0 ? "octree" : "sweep");
}

// In it the lanes leave the ball farther off than an edge may stray; the next edge was as long as the one before, for
// ever.
TEST(TightCells, ASweepEndsWhereEdgesAreRefusedForTheirEnds) {
  const std::uint64_t seed = 7;
  const TightMachine machine = random_tight_machine(seed, resolution);
  const Outcome outcome = plan_seed(machine, seed);
  ASSERT_TRUE(outcome.result) << outcome.refusal;
  expect_good(machine, outcome);
}

TEST(TightCells, NoPlanForARandomTightMachineLetsPartsOverlap) {
  const std::uint64_t from = number_from("SCULPT_TIGHT_FROM", 1), count = number_from("SCULPT_TIGHT_CELLS", 4);
  const bool tell = count > 4;
  int planned = 0;
  for (std::uint64_t seed = from; seed < from + count; ++seed) {
    const TightMachine machine = random_tight_machine(seed, resolution);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + machine.title);
    if (tell) std::cout << "seed " << seed << ": " << machine.title << std::flush;
    const Outcome outcome = plan_seed(machine, seed);
    if (tell)
      std::cout << ": "
                << (outcome.result ? std::to_string(outcome.result->report.voxels.removed) + " removed, " +
                                         std::to_string(outcome.result->report.voxels.residue) + " left"
                                   : outcome.refusal)
                << std::endl;
    if (!outcome.result) continue;
    if (outcome.result->report.voxels.removed > 0) ++planned;
    expect_good(machine, outcome);
  }
  EXPECT_GT(planned, 0);
}

}  // namespace
}  // namespace sculpt
