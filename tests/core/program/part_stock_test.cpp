#include "core/program/part_stock.hpp"

#include <set>

#include "core/material/binvox.hpp"
#include "tests/core/program/program_cases.hpp"
#include "tests/core/trajectory/milling/random_milled.hpp"

namespace sculpt {
namespace {

TEST(PartStock, IsTheCubeLessWhatIsCut) {
  const Cell cell = shipped_cell("gantry");
  Random random(9);
  const PlanPath path = path_of(cell, wander(cell, random, 60), 8);
  PartStock stock(path);
  std::set<int> cut;  // all of these are in one row
  for (std::size_t point = 0; point < path.size(); ++point) {
    if (path.edge_to(point).voxels > 0) cut.insert(path.voxel_of(point, 0).i);
    if (point % 7 != 0) continue;
    const VoxelSet standing = read_binvox(stock.at(point));
    for (int i = 0; i < 8; ++i) EXPECT_EQ(standing.contains({i, 3, 4}), !cut.contains(i)) << point;
    EXPECT_TRUE(standing.contains({0, 0, 0}));
  }
  EXPECT_GT(cut.size(), 3U);
}

TEST(PartStock, IsTheCubeLessWhatMillingToolsSweep) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    VoxelSet standing(16, true);
    MilledPlan plan = random_milled(seed, standing, 60);
    std::ostringstream out;
    TrajectoryWriter writer(out, plan.header);
    for (std::size_t at = 0; at < plan.keyframes.size(); ++at) {
      plan.keyframes[at].q[0] = from_quanta(static_cast<std::int64_t>(at / 2 + 1));  // every other one moves nothing
      writer.add(plan.keyframes[at]);
    }
    writer.finish();
    std::istringstream in(out.str());
    const PlanPath path(in);
    ASSERT_EQ(path.size(), 31U);
    PartStock stock(path);
    EXPECT_EQ(read_binvox(stock.at(0)), standing);
    for (std::size_t point = 1; point < path.size(); ++point) {
      standing -= plan.removed[2 * point - 2];
      standing -= plan.removed[2 * point - 1];
      if (point % 3 != 0) continue;
      EXPECT_EQ(read_binvox(stock.at(point)), standing) << point;
    }
    EXPECT_LT(standing.size(), 16 * 16 * 16U);
  }
}

TEST(PartStock, ComesWithEachPartThatAsksForIt) {
  const Cell cell = shipped_cell("gantry");
  Random random(9);
  const PlanPath path = path_of(cell, wander(cell, random, 60), 8);
  ProgramDemands demands = demands_of(Dialect::gcode);
  demands.part_keyframes = 20;
  demands.stock_files = true;
  const Made made = make(path, cell, demands);
  PartStock stock(path);
  for (std::size_t part = 1; part <= made.report.parts; ++part)
    EXPECT_EQ(made.files.at(ProgramNames{"bust", part, 0, {}}.part_name() + ".binvox"), stock.at(20 * (part - 1)));
  demands.dialect = Dialect::ros2;
  demands.part_keyframes.reset();
  EXPECT_NE(refusal(path, cell, demands).find("--stock-files"), std::string::npos);
}

}  // namespace
}  // namespace sculpt
