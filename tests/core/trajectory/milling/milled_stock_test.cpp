#include "core/trajectory/milling/milled_stock.hpp"

#include <gtest/gtest.h>

#include "tests/core/trajectory/milling/random_milled.hpp"

namespace sculpt {
namespace {

TEST(MilledStock, TakesWhatEachCutSweepsAsRunsAlongX) {
  std::size_t runs_seen = 0, of_many = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    VoxelSet stock(16, true);
    Random random(seed);
    for (int hole = 0; hole < 60; ++hole) stock.words()[random.next() % stock.words().size()] &= random.next();
    const MilledPlan plan = random_milled(seed, stock, 60);
    MilledStock milled(plan.header, stock);
    VoxelSet standing = stock;
    for (std::size_t at = 0; at < plan.keyframes.size(); ++at) {
      VoxelSet taken(16);
      std::size_t count = 0;
      for (const auto& [first, last] : milled.take(*plan.keyframes[at].mill, plan.keyframes[at].cut)) {
        EXPECT_EQ(first.j, last.j);
        EXPECT_EQ(first.k, last.k);
        for (Voxel v = first; v.i <= last.i; ++v.i, ++count) taken.insert(v);
        ++runs_seen;
        of_many += last.i > first.i + 1;
      }
      EXPECT_EQ(count, taken.size()) << "each voxel once";
      EXPECT_EQ(taken, plan.removed[at]) << "keyframe " << at;
      standing -= plan.removed[at];
      EXPECT_EQ(milled.standing(), standing);
    }
  }
  EXPECT_GT(runs_seen, 500u);
  EXPECT_GT(of_many, 100u);
}

}  // namespace
}  // namespace sculpt
