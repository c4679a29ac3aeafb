#include "core/trajectory/timeline.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "core/trajectory/binary/segment.hpp"
#include "core/trajectory/text/trajectory_line.hpp"
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

}  // namespace
}  // namespace sculpt
