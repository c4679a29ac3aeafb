#include "core/picture/stock_moment.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "core/base/error.hpp"
#include "core/trajectory/timeline.hpp"
#include "core/trajectory/writer.hpp"
#include "tests/core/trajectory/milling/random_milled.hpp"
#include "tests/core/trajectory/random_trajectory.hpp"

namespace sculpt {
namespace {

constexpr int n = 16;

Keyframe move_to(double q) {
  return {Configuration::Constant(3, q), false, {}, {}};
}
Keyframe cut_to(double q, Voxel first, Voxel last) {
  return {Configuration::Constant(3, q), true, first, last};
}
// A row of eight from x = 0, one of four that goes back, and a move between them.
const std::vector<Keyframe> plan{cut_to(1, {0, 3, 15}, {7, 3, 15}), move_to(2), cut_to(4, {5, 9, 15}, {2, 9, 15}),
                                 move_to(0)};

/// Stock but for the lowest layer; keep is what is below 8.
VoxelGrid half_kept() {
  VoxelGrid voxels{VoxelSet(n), VoxelSet(n)};
  for_each_voxel(VoxelSet(n, true), [&](Voxel v) {
    if (v.k > 0) voxels.stock.insert(v);
    if (v.k > 0 && v.k < 8) voxels.keep.insert(v);
  });
  return voxels;
}

std::string timeline() {
  std::ostringstream out;
  TimelineWriter writer(out, sample_header(), half_kept());
  for (const Keyframe& keyframe : plan) writer.add(keyframe);
  writer.flush();
  return out.str();
}

std::string trajectory() {
  std::ostringstream out;
  TrajectoryWriter writer(out, sample_header());
  for (const Keyframe& keyframe : plan) writer.add(keyframe);
  writer.finish();
  return out.str();
}

TEST(StockMoment, OfATimelineIsWhatWasThereLessWhatIsCutByThen) {
  const VoxelGrid start = half_kept();
  for (const auto& [share, removed] :
       {std::pair{0.0, 0}, {0.125, 4}, {0.25, 8}, {0.5, 8}, {0.625, 10}, {0.75, 12}, {1.0, 12}}) {
    const StockMoment moment = moment_of_timeline(timeline(), share, true);
    EXPECT_EQ(moment.keyframes, 4u);
    EXPECT_EQ(moment.removed, static_cast<std::uint64_t>(removed)) << share;
    EXPECT_EQ(moment.standing.size(), start.stock.size() - static_cast<std::size_t>(removed)) << share;
    EXPECT_EQ(moment.start.keep, start.keep);
    EXPECT_EQ(moment.left.size(), start.stock.size() - start.keep.size() - 12);
  }
  const StockMoment moment = moment_of_timeline(timeline(), 0.625, true);
  EXPECT_FALSE(moment.standing.contains({4, 9, 15})) << "the row goes back from 5";
  EXPECT_TRUE(moment.standing.contains({3, 9, 15}));
}

TEST(StockMoment, OfATimelineThatGrowsNothingIsLeftOver) {
  const std::string bytes = timeline();
  const StockMoment whole = moment_of_timeline(bytes, 1, false);
  EXPECT_EQ(whole.left.size(), 0u);
  EXPECT_EQ(moment_of_timeline(bytes.substr(0, bytes.size() - 1), 1, false).keyframes, 3u) << "a move is one byte";
  EXPECT_EQ(moment_of_timeline(bytes.substr(0, bytes.size() - 2), 1, false).keyframes, 2u)
      << "a cut that is there in part";
}

TEST(StockMoment, OfATrajectoryTheGridIsFullAndJointsAreBetweenKeyframes) {
  std::istringstream in(trajectory());
  const StockMoment moment = moment_of_trajectory(in, 0.625);
  EXPECT_EQ(moment.removed, 10u);
  EXPECT_EQ(moment.standing.size(), static_cast<std::size_t>(n * n * n - 10));
  EXPECT_EQ(moment.start.keep.size(), static_cast<std::size_t>(n * n * n - 12));
  EXPECT_EQ(moment.left.size(), 0u);
  EXPECT_NEAR(moment.q[1], 3, 1e-12);
  std::istringstream again(trajectory());
  EXPECT_TRUE(moment_of_trajectory(again, 0).q.isApprox(sample_header().home));
}

TEST(StockMoment, OfMillingToolsEachCutTakesWhatItSweeps) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const VoxelSet stock(n, true);
    const MilledPlan milled = random_milled(seed, stock, 60);
    std::ostringstream out;
    TimelineWriter writer(out, milled.header, {stock, VoxelSet(n)});
    for (const Keyframe& keyframe : milled.keyframes) writer.add(keyframe);
    writer.flush();
    VoxelSet standing = stock;
    int tool = 0;
    for (std::size_t over = 0; over <= milled.keyframes.size(); ++over) {
      const double share = static_cast<double>(over) / static_cast<double>(milled.keyframes.size());
      std::istringstream in(write_text(milled.header, milled.keyframes));
      for (const StockMoment& moment : {moment_of_timeline(out.str(), share, true), moment_of_trajectory(in, share)}) {
        EXPECT_EQ(moment.standing, standing);
        EXPECT_EQ(moment.removed, stock.size() - standing.size());
        EXPECT_EQ(moment.tool, tool);
      }
      if (over == milled.keyframes.size()) break;
      const StockMoment between =
          moment_of_timeline(out.str(), share + 0.5 / static_cast<double>(milled.keyframes.size()), true);
      EXPECT_EQ(between.removed, stock.size() - standing.size() + milled.removed[over].size() / 2);
      EXPECT_EQ(between.standing.size(), stock.size() - between.removed);
      standing -= milled.removed[over];
      if (milled.keyframes[over].mill->is_change()) tool = milled.keyframes[over].mill->tool;
    }
  }
}

TEST(StockMoment, TimelinesAreToldFromTrajectories) {
  EXPECT_TRUE(is_timeline(timeline()));
  EXPECT_FALSE(is_timeline(trajectory()));
  EXPECT_FALSE(is_timeline("SCT1...\n"));
  EXPECT_FALSE(is_timeline(""));
}

TEST(StockMoment, ATimelineThatCannotBeIsRefused) {
  const std::string header = timeline().substr(0, timeline().find('\n') + 1);
  for (const std::string& bytes : {std::string(), header.substr(0, 20), header, header + "\x05",  // two voxels only
                                   header + "\xff\xff\xff\x7f",                                   // more than there are
                                   timeline() + std::string(1, '\x08')})  // anywhere, and no place
    try {
      const StockMoment moment = moment_of_timeline(bytes, 1, true);
      EXPECT_EQ(moment.keyframes, 4u) << "what is not there as a whole is not counted";
    } catch (const InputError& error) {
      EXPECT_EQ(error.code(), "trajectory_invalid");
    }
  EXPECT_THROW(moment_of_timeline(header, 1, true), InputError);
  EXPECT_THROW(moment_of_timeline(header + "\xff\xff\xff\x7f", 1, true), InputError);
}

}  // namespace
}  // namespace sculpt
