#include "core/base/watch.hpp"

#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

namespace sculpt {
namespace {

TEST(Watch, WorksWithNobodyListening) {
  EXPECT_NO_THROW(Watch{}.step(Stage::plan, 1, 2));
}

TEST(Watch, TellsEveryStep) {
  std::vector<Progress> told;
  const Watch watch{{}, [&](const Progress& progress) { told.push_back(progress); }};
  watch.step(Stage::voxelize, 3, 9);
  watch.step(Stage::verify, 9, 9);
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(told[0].stage, Stage::voxelize);
  EXPECT_EQ(told[0].done, 3u);
  EXPECT_EQ(told[1].stage, Stage::verify);
  EXPECT_EQ(told[1].total, 9u);
}

TEST(Watch, ThrowsFromTheStepAfterAStopAndTellsNoMore) {
  std::stop_source source;
  int told = 0;
  const Watch watch{source.get_token(), [&](const Progress&) { ++told; }};
  watch.step(Stage::plan, 0, 10);
  source.request_stop();
  EXPECT_THROW(watch.step(Stage::plan, 1, 10), Cancelled);
  EXPECT_THROW(watch.step(Stage::plan, 2, 10), Cancelled);
  EXPECT_EQ(told, 1);
}

TEST(Watch, CopiesShareTheStop) {
  std::stop_source source;
  const Watch watch{source.get_token(), {}};
  const Watch copy = watch;
  source.request_stop();
  EXPECT_THROW(copy.step(Stage::load, 0, 1), Cancelled);
}

TEST(Watch, OneLooseVoxelIsANoteAndManyAreAWarning) {
  for (const auto& [loose, keep, is_much] : {std::tuple(0, 0, false),
                                             {1, 551, false},
                                             {10, 551, false},
                                             {12, 551, true},
                                             {999, 1000000, false},
                                             {1000, 1000000, true},
                                             {2496, 300000, true}}) {
    const Doubts doubts{static_cast<std::uint64_t>(keep), static_cast<std::uint64_t>(loose), 0, {}};
    EXPECT_EQ(doubts.is_much_loose(), is_much) << loose << " of " << keep;
  }
}

TEST(Stage, EveryStageHasItsOwnName) {
  EXPECT_STREQ(name(Stage::load), "load");
  EXPECT_STREQ(name(Stage::voxelize), "voxelize");
  EXPECT_STREQ(name(Stage::octree), "octree");
  EXPECT_STREQ(name(Stage::plan), "plan");
  EXPECT_STREQ(name(Stage::verify), "verify");
  EXPECT_STREQ(name(Stage::write), "write");
}

TEST(InputError, CarriesItsCodeAndSentence) {
  const InputError error("cell_unknown", "cell \"x\" does not exist");
  EXPECT_EQ(error.code(), "cell_unknown");
  EXPECT_STREQ(error.what(), "cell \"x\" does not exist");
}

}  // namespace
}  // namespace sculpt
