#include "core/motion/transit.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "core/motion/random_configuration.hpp"
#include "core/trajectory/quantum.hpp"
#include "tests/core/plan/jobs.hpp"

namespace sculpt {
namespace {

class Transit : public testing::Test {
 protected:
  /// Two random configurations that the direct edge does not join.
  std::pair<Configuration, Configuration> separated(std::uint64_t seed) const {
    Random random(seed);
    while (true) {
      const Configuration a = rounded(random_configuration(scene.chain(), random));
      const Configuration b = rounded(random_configuration(scene.chain(), random));
      if (scene.contact_at(a) == Contact::none && scene.contact_at(b) == Contact::none &&
          scene.certify(a, b) != Contact::none)
        return {a, b};
    }
  }

  const Cell cell = parse_cell(shipped_cell_files("panda-turntable"));
  const Scene scene{cell, cell.grid(8), VoxelSet(8, true)};
};

TEST_F(Transit, PathsRoundTheStockAreCertifiedFromEndToEnd) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto [from, to] = separated(seed);
    const auto path = plan_transit(scene, from, to, seed, {}).path;
    if (path.empty()) continue;
    ++found;
    EXPECT_EQ(path.front(), from);
    EXPECT_EQ(path.back(), to);
    for (std::size_t i = 1; i < path.size(); ++i) EXPECT_EQ(scene.certify(path[i - 1], path[i]), Contact::none);
  }
  EXPECT_GE(found, 9) << "RRTConnect should solve most of these";
}

TEST_F(Transit, DependsOnTheSeedAloneAlsoOnOtherThreads) {
  const auto [from, to] = separated(1);
  const auto first = plan_transit(scene, from, to, 7, {}).path;
  ASSERT_FALSE(first.empty());
  std::vector<std::vector<Configuration>> others(4);
  std::vector<std::jthread> threads;
  for (std::size_t t = 0; t < others.size(); ++t)
    threads.emplace_back([&, t] {
      const Scene own(cell, cell.grid(8), VoxelSet(8, true));
      plan_transit(own, from, to, 100 + t, {});
      others[t] = plan_transit(own, from, to, 7, {}).path;
    });
  threads.clear();
  for (const auto& other : others) EXPECT_EQ(other, first);
}

TEST_F(Transit, AStopEndsTheSearchWithoutAPath) {
  const auto [from, to] = separated(2);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_TRUE(plan_transit(scene, from, to, 0, stop.get_token()).path.empty());
}

TEST_F(Transit, ShorteningKeepsTheEndsAndOnlyCertifiedEdges) {
  const auto [from, to] = separated(3);
  auto path = plan_transit(scene, from, to, 3, {}, {20000}).path;
  ASSERT_FALSE(path.empty());
  std::vector<Configuration> detour;
  for (std::size_t i = 1; i < path.size(); ++i)
    for (int s = 0; s < 4; ++s) detour.push_back(path[i - 1] + (path[i] - path[i - 1]) * (s / 4.0));
  detour.push_back(to);
  const auto kept = shorten(scene, detour);
  EXPECT_LE(kept.size(), path.size() + 1);
  EXPECT_EQ(kept.front(), from);
  EXPECT_EQ(kept.back(), to);
  for (std::size_t i = 1; i < kept.size(); ++i) EXPECT_EQ(scene.certify(kept[i - 1], kept[i]), Contact::none);
}

}  // namespace
}  // namespace sculpt
