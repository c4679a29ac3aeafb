#include "core/trajectory/binary/binary.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/base/error.hpp"
#include "core/base/sha256.hpp"
#include "core/trajectory/binary/binary_frame.hpp"
#include "core/trajectory/quantum.hpp"
#include "core/trajectory/reader.hpp"
#include "tests/core/trajectory/random_trajectory.hpp"

namespace sculpt {
namespace {

std::string write_binary(const TrajectoryHeader& header, const std::vector<Keyframe>& keyframes) {
  std::ostringstream out;
  BinaryWriter writer(out, header);
  for (const Keyframe& keyframe : keyframes) writer.add(keyframe);
  writer.finish();
  return out.str();
}

std::vector<Keyframe> read_whole(const std::string& sct) {
  std::istringstream in(sct);
  TrajectoryReader reader(in);
  std::vector<Keyframe> keyframes;
  while (auto keyframe = reader.next()) keyframes.push_back(std::move(*keyframe));
  return keyframes;
}

void expect_same(const Keyframe& a, const Keyframe& b) {
  ASSERT_EQ(a.q, b.q);
  ASSERT_EQ(a.cut, b.cut);
  ASSERT_EQ(a.first, b.first);
  ASSERT_EQ(a.last, b.last);
}

void expect_same(const std::vector<Keyframe>& a, const std::vector<Keyframe>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t at = 0; at < a.size(); ++at) expect_same(a[at], b[at]);
}

// A grid in which rows are long.
TrajectoryHeader header_of(int n) {
  TrajectoryHeader header = sample_header();
  header.grid = {n, 0.2 / n, Vec3(-0.1, -0.1, 0)};
  return header;
}

TEST(Binary, HasTheDocumentedLayout) {
  TrajectoryHeader header = sample_header();
  const auto q = [](double x) { return Configuration::Constant(3, x); };
  const std::string sct = write_binary(header, {{q(1e-5), true, {1, 2, 3}, {1, 2, 8}},
                                                {q(2e-5), true, {1, 2, 9}, {1, 2, 14}},
                                                {q(2e-5), false, {}, {}},
                                                {q(2e-5), true, {1, 3, 14}, {1, 3, 14}}});
  const std::string line = write_text(header, {}).substr(0, write_text(header, {}).find('\n'));
  std::string expected = "SCULPTRJ";
  append_word(expected, std::uint32_t{2});
  append_word(expected, static_cast<std::uint32_t>(line.size()));
  expected += line;
  append_word(expected, crc32_of(expected));

  // Token of the first: 2 + start 6 (anywhere) + 7 * (direction 5 (+k) + 6 * (6 - 1)) = 253, then the offsets 1 2 3
  // zigzagged; the second goes on alike; the third moves; the last steps by +j: 2 + 3 + 7 * 3 = 26. Each joint is least
  // as first differences 100 100 0 0.
  const std::string column("\x01\xc8\x01\xc8\x01\x00\x01", 7);
  const std::string body = std::string("\xfd\x01\x02\x04\x06\x01\x00\x1a", 8) + column + column + column;
  std::string head("\x01\x04\0\0\0\0\0\0\0\0\0\0\0", 13);
  append_word(head, static_cast<std::uint32_t>(body.size()));
  const std::uint64_t first = expected.size();
  expected += head;
  append_word(expected, crc32_of(head + body));
  expected += body;

  const std::uint64_t index = expected.size();
  std::string entries("\x02\x01\0\0\0", 5);
  for (std::uint64_t value : {first, std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{4}, std::uint64_t{13}, index})
    append_word(entries, value);
  append_word(entries, crc32_of(entries));
  expected += entries;
  EXPECT_EQ(sct, expected + sha256_hex(expected));
  EXPECT_EQ(crc32_of("123456789"), 0xcbf43926u) << "zlib's CRC-32";
}

TEST(Binary, ComesBackBitForBitOverManySegments) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TrajectoryHeader header = sample_header();
    Random random(seed);
    std::vector<Keyframe> keyframes(2 * 4096 + seed);
    for (Keyframe& keyframe : keyframes) keyframe = random_keyframe(random, header, Values::stored);
    expect_same(read_whole(write_binary(header, keyframes)), keyframes);
  }
}

TEST(Binary, EmptyTrajectoriesHaveNoSegments) {
  std::istringstream in(write_binary(sample_header(), {}));
  EXPECT_TRUE(read_whole(in.str()).empty());
  const BinaryFile file(in);
  EXPECT_EQ(file.keyframes(), 0u);
  EXPECT_TRUE(file.segments().empty());
  EXPECT_THROW(file.segment_that_removes(0), std::out_of_range);
}

TEST(Binary, RowsComeBackInAllSixDirections) {
  const TrajectoryHeader header = header_of(16);
  std::vector<Keyframe> keyframes;
  for (Voxel step : face_steps)
    for (int length : {1, 2, 7}) {
      const Voxel middle{8, 8, 8}, ahead = middle + step * (length - 1);
      keyframes.push_back({header.home, true, middle, ahead});
      keyframes.push_back({header.home, true, ahead, ahead});
      keyframes.push_back({header.home, false, {}, {}});
      keyframes.push_back({header.home, true, ahead + step, ahead + step});
      keyframes.push_back({header.home, true, ahead, middle});
    }
  for (Keyframe& keyframe : keyframes) keyframe.q = rounded(keyframe.q);
  expect_same(read_whole(write_binary(header, keyframes)), keyframes);
}

TEST(Binary, SmoothRowsTakeAboutTwoBytesAJointAndOneForTheVoxels) {
  const TrajectoryHeader header = header_of(128);
  const std::vector<Keyframe> keyframes = smooth_rows(header, 2, 8);
  const double bytes = static_cast<double>(write_binary(header, keyframes).size());
  EXPECT_LT(bytes / static_cast<double>(keyframes.size()), 2.0 * 3 + 1.5);
}

TEST(BinaryFile, GivesAnySegmentAlone) {
  const TrajectoryHeader header = header_of(64);
  const std::vector<Keyframe> keyframes = smooth_rows(header, 20, 4);
  std::istringstream in(write_binary(header, keyframes));
  const BinaryFile file(in);
  EXPECT_EQ(file.header().joints, header.joints);
  EXPECT_EQ(file.keyframes(), keyframes.size());
  ASSERT_EQ(file.segments().size(), (keyframes.size() + 4095) / 4096);
  ASSERT_GE(file.segments().size(), 4u);
  for (std::size_t segment : {3u, 0u, 2u, 1u}) {
    const auto first = keyframes.begin() + static_cast<std::ptrdiff_t>(file.segments()[segment].first_keyframe);
    expect_same(file.read(segment), {first, first + 4096});
  }
  EXPECT_THROW(file.read(file.segments().size()), std::out_of_range);
}

TEST(BinaryFile, FindsTheSegmentThatRemovesAVoxel) {
  const TrajectoryHeader header = header_of(64);
  std::vector<Keyframe> keyframes = smooth_rows(header, 4, 4);
  keyframes.insert(keyframes.begin() + 4096, 9000, Keyframe{rounded(header.home), false, {}, {}});  // segments of moves
  std::istringstream in(write_binary(header, keyframes));
  const BinaryFile file(in);
  EXPECT_EQ(file.removed(), 4u * 64 * 64);
  for (std::uint64_t ordinal = 0; ordinal < file.removed(); ordinal += 97) {
    const std::size_t segment = file.segment_that_removes(ordinal);
    std::uint64_t end = file.segments()[segment].first_removed;
    EXPECT_LE(end, ordinal);
    for (const Keyframe& keyframe : file.read(segment)) end += static_cast<std::uint64_t>(run_length(keyframe));
    EXPECT_GT(end, ordinal);
  }
  EXPECT_THROW(file.segment_that_removes(file.removed()), std::out_of_range);
}

TEST(BinaryWriter, RefusesRunsThatDoNotLieInTheGridAlongOneAxis) {
  const TrajectoryHeader header = sample_header();
  const Configuration q = rounded(header.home);
  EXPECT_THROW(write_binary(header, {{q, true, {0, 0, 0}, {1, 1, 0}}}), InputError);
  EXPECT_THROW(write_binary(header, {{q, true, {0, 0, 15}, {0, 0, 16}}}), InputError);
}

}  // namespace
}  // namespace sculpt
