// What was cut once is cut again from the keyframes of the file.
#include "core/mill/mill_cuts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.hpp"
#include "core/cell/milling/tool_library.hpp"
#include "tests/core/mill/finish/quads.hpp"
#include "tests/core/mill/milled_plan.hpp"

namespace sculpt {
namespace {

constexpr double edge_m = 0.02;

TEST(CutList, KnowsToolAndDirectionOfEachCutAndWhereItBegins) {
  const auto keyframe = [](bool cut, const MillStep& step) { return Keyframe{{}, cut, {}, {}, step}; };
  CutList list;
  list.add(keyframe(false, {{1, 2, 3}, 4}));
  list.add(keyframe(true, {{5, 6, 7}, 4}));
  list.add(keyframe(false, {{8, 9, 10}, 4}));
  list.add(keyframe(true, {{11, 12, 13}, 4}));
  list.add(keyframe(false, {{1, 1, 1}, 5}));
  list.add(keyframe(true, {{2, 2, 2}, 5}));
  list.add(keyframe(false, {{}, -1, 1}));
  list.add(keyframe(false, {{3, 3, 3}, 5}));
  list.add(keyframe(true, {{4, 4, 4}, 5}));
  const std::vector<MillCuts> cuts = list.take();
  ASSERT_EQ(cuts.size(), 3U);
  EXPECT_EQ(std::pair(cuts[0].tool, cuts[0].direction), std::pair(0, 4));
  ASSERT_EQ(cuts[0].edges.size(), 2U);
  EXPECT_EQ(cuts[0].edges[1].from, (QuantaPoint{8, 9, 10}));
  EXPECT_EQ(cuts[0].edges[1].to, (QuantaPoint{11, 12, 13}));
  EXPECT_EQ(std::pair(cuts[1].tool, cuts[1].direction), std::pair(0, 5));
  EXPECT_EQ(std::pair(cuts[2].tool, cuts[2].direction), std::pair(1, 5));
  EXPECT_EQ(cuts[2].edges.front().from, (QuantaPoint{3, 3, 3}));
}

class CutAgain : public testing::Test {
 protected:
  struct Left {
    VoxelSet left, standing;
    std::vector<double> excess;
    bool operator==(const Left&) const = default;
  };
  Left cut(const std::vector<MillCuts>& cuts, int threads) const {
    const Helpers helpers(threads);
    MillStock stock(slab.voxels.stock, slab.grid);
    Nails nails(slab.mesh, slab.voxels, slab.grid, 3000, 7);
    cut_again(job, cuts, stock, nails, {0, helpers, watch});
    Left left{stock.left().voxels(), stock.standing(), {}};
    for (std::size_t at = 0; at < nails.size(); ++at) left.excess.push_back(nails.excess(at));
    return left;
  }
  /// Straight ways through the upper half, in all directions.
  static std::vector<MillCuts> random_cuts() {
    Random random(3);
    const auto place = [&] { return quanta_of(Vec3(random.unit(), random.unit(), 0.5 + random.unit() / 2) * edge_m); };
    std::vector<MillCuts> cuts;
    for (int number = 0; number < 40; ++number) {
      cuts.push_back({number % 2, number % static_cast<int>(mill_directions().size()), {}});
      for (int each = 0; each < 5; ++each) cuts.back().edges.push_back({place(), place()});
    }
    return cuts;
  }

  const PartInGrid slab = make_slab(edge_m);
  const Cell cell = parse_cell(milled::make_job("bust", slab.grid.n, {"D6"}).cell);
  const std::vector<MillTool> tools =
      choose_tools(read_tool_library(SOURCE_DIR "/config/tools/carving.json", {}), {"D6", "D3"});
  const MillJob job{cell, slab.grid, slab.voxels, slab.mesh, tools, {}, {}, {}};
  Watch watch;
};

TEST_F(CutAgain, GivesTheSameBitsInAnyOrder) {
  std::vector<MillCuts> cuts = random_cuts();
  const Left expected = cut(cuts, 1);
  EXPECT_LT(expected.left.size(), slab.voxels.stock.size());
  EXPECT_LT(expected.standing.size(), slab.voxels.stock.size());
  EXPECT_LT(std::ranges::min(expected.excess), 1e-3);
  std::ranges::reverse(cuts);
  for (MillCuts& each : cuts) std::rotate(each.edges.begin(), each.edges.begin() + 2, each.edges.end());
  EXPECT_TRUE(cut(cuts, 2) == expected);
}

TEST_F(CutAgain, EndsWhenItIsAskedTo) {
  std::stop_source stop;
  stop.request_stop();
  watch.stop = stop.get_token();
  EXPECT_THROW(cut(random_cuts(), 2), Cancelled);
}

}  // namespace
}  // namespace sculpt
