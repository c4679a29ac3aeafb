#include "core/trajectory/timeline.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "core/base/error.hpp"
#include "core/trajectory/binary/segment.hpp"
#include "core/trajectory/text/trajectory_line.hpp"
#include "tests/core/trajectory/milling/random_milled.hpp"
#include "tests/core/trajectory/random_trajectory.hpp"

namespace sculpt {
namespace {

VoxelGrid grid_of(int n, const std::function<Label(Voxel)>& label) {
  VoxelGrid voxels{VoxelSet(n), VoxelSet(n)};
  for_each_voxel(VoxelSet(n, true), [&](Voxel v) {
    if (label(v) != Label::air) voxels.stock.insert(v);
    if (label(v) == Label::keep) voxels.keep.insert(v);
  });
  return voxels;
}

std::string timeline_of(const VoxelGrid& voxels, const std::vector<Keyframe>& keyframes) {
  std::ostringstream out;
  TimelineWriter writer(out, sample_header(), voxels);
  for (const Keyframe& keyframe : keyframes) writer.add(keyframe);
  writer.flush();
  return out.str();
}

// The tokens alone: what a segment of .sct begins with, before its joints.
std::string tokens_of(const std::vector<Keyframe>& keyframes) {
  std::string tokens;
  LastCut last;
  for (std::size_t at = 0; at < keyframes.size(); ++at) {
    if (at % max_segment_keyframes == 0) last = {};
    append_token(tokens, keyframes[at], last);
  }
  return tokens;
}

TEST(Timeline, BeginsWithTheHeaderAndOneRunOfAFullGrid) {
  const auto all = [](Voxel) { return Label::remove; };
  // 3 * 4095 + 2 = 12287 = 0b1011111 1111111
  EXPECT_EQ(timeline_of(grid_of(16, all), {}), header_line(sample_header()) + "\n\xff\x5f");
}

TEST(Timeline, RunsGoOnWhereWordsAndRowsEnd) {
  const auto label = [](Voxel v) {
    const int at = v.i + 16 * (v.j + 16 * v.k);
    return at < 3 ? Label::air : at < 200 ? Label::keep : Label::remove;
  };
  const std::string head = header_line(sample_header()) + "\n";
  // air 3: 6; keep 197: 589; remove 3896: 11687
  const std::string runs = "\x06\xcd\x04\xa7\x5b";
  EXPECT_EQ(timeline_of(grid_of(16, label), {}), head + runs);
}

TEST(Timeline, TokensAreThoseOfTheBinaryFormAlsoBehindASegment) {
  const TrajectoryHeader header = sample_header();
  const std::vector<Keyframe> rows = smooth_rows(header, 16, 1);
  ASSERT_GE(rows.size(), max_segment_keyframes);
  std::vector<Keyframe> twice = rows;
  twice.insert(twice.end(), rows.begin(), rows.end());
  const auto all = [](Voxel) { return Label::remove; };
  const std::string start = timeline_of(grid_of(16, all), {});
  EXPECT_EQ(timeline_of(grid_of(16, all), twice), start + tokens_of(twice));

  SegmentEncoder segment;
  for (std::size_t at = 0; at < max_segment_keyframes; ++at) segment.add(twice[at]);
  const std::string body = segment.take();
  const std::string first = tokens_of({twice.begin(), twice.begin() + max_segment_keyframes});
  EXPECT_EQ(body.substr(0, first.size()), first);
}

TEST(Timeline, WhatWasWrittenStaysWhenMoreComes) {
  const auto all = [](Voxel) { return Label::remove; };
  const std::vector<Keyframe> rows = smooth_rows(sample_header(), 2, 1);
  const std::string whole = timeline_of(grid_of(16, all), rows);
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, rows.size() / 2}) {
    const std::string part = timeline_of(grid_of(16, all), {rows.begin(), rows.begin() + static_cast<long>(count)});
    EXPECT_EQ(whole.substr(0, part.size()), part);
  }
}

/// What a reader of these bytes is told of a plan's first keyframes; how many.
std::size_t expect_told(const MilledPlan& plan, const std::string& bytes) {
  TimelineReader reader(bytes);
  std::size_t at = 0;
  for (; const auto step = reader.next(); ++at) {
    const Keyframe& keyframe = plan.keyframes[at];
    EXPECT_EQ(step->cut, keyframe.cut);
    EXPECT_EQ(step->tool, keyframe.mill->tool);
    VoxelSet gone(16);
    for (const auto& [first, last] : step->runs)
      for (Voxel v = first; v.i <= last.i; ++v.i) gone.insert(v);
    EXPECT_EQ(gone, plan.removed[at]) << "keyframe " << at;
  }
  return at;
}

TEST(Timeline, OfMillingToolsHasTheRunsOfEachCutAndMayEndAnywhere) {
  const VoxelSet stock(16, true);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const MilledPlan plan = random_milled(seed, stock, 80);
    std::ostringstream out;
    TimelineWriter writer(out, plan.header, {stock, VoxelSet(16)});
    writer.flush();
    const std::size_t begin = out.str().size();
    std::vector<std::size_t> ends;
    for (const Keyframe& keyframe : plan.keyframes) {
      writer.add(keyframe);
      writer.flush();
      ends.push_back(out.str().size());
    }
    const std::string whole = out.str();
    EXPECT_EQ(expect_told(plan, whole), plan.keyframes.size());
    for (std::size_t length = begin; length < whole.size(); length += 7)
      EXPECT_EQ(expect_told(plan, whole.substr(0, length)),
                static_cast<std::size_t>(std::ranges::upper_bound(ends, length) - ends.begin()));
  }
}

TEST(Timeline, OfMillingToolsThatCannotBeIsRefused) {
  std::ostringstream out;
  TimelineWriter(out, milled_header(), {VoxelSet(16, true), VoxelSet(16)}).flush();
  const auto refused = [&](const std::string& tokens) {
    const std::string bytes = out.str() + tokens;
    TimelineReader reader(bytes);
    EXPECT_THROW(reader.next(), InputError);
  };
  refused(std::string("\x01\x02", 2));              // a tool that is not there
  refused(std::string("\x03\x00", 2));              // a move in a cut
  refused(std::string("\x03\x08\x3f\x00\x00", 5));  // outside of the grid
}

}  // namespace
}  // namespace sculpt
