// .sct files that are cut short, changed, or made to mislead with checksums that fit. Always an InputError, never
// anything else, and never more memory than the file's size is worth.
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/base/sha256.hpp"
#include "core/trajectory/binary/binary.hpp"
#include "core/trajectory/binary/binary_frame.hpp"
#include "core/trajectory/binary/segment.hpp"
#include "core/trajectory/reader.hpp"
#include "tests/core/trajectory/random_trajectory.hpp"

namespace sculpt {
namespace {

template <typename Read>
std::string refusal(const Read& read) {
  try {
    read();
    return "";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), "trajectory_invalid");
    return error.what();
  }
}

// Empty if the bytes were read to their end, else the sentence of the refusal.
std::string read_all(const std::string& bytes) {
  return refusal([&] {
    std::istringstream in(bytes);
    TrajectoryReader reader(in);
    while (reader.next()) {
    }
  });
}

std::string read_by_segments(const std::string& bytes) {
  return refusal([&] {
    std::istringstream in(bytes);
    const BinaryFile file(in);
    for (std::size_t segment = 0; segment < file.segments().size(); ++segment) file.read(segment);
  });
}

// A file around one body, with all checksums as they should be.
std::string file_with(const TrajectoryHeader& header, std::size_t keyframes, const std::string& body,
                      std::uint64_t removed) {
  std::string bytes = preamble_bytes(header);
  const std::uint64_t first = bytes.size();
  const SegmentBytes segment{keyframes, 0, body};
  bytes += segment.head() + body;
  bytes += index_bytes({{first, 0, 0}}, keyframes, removed, bytes.size());
  return bytes + sha256_hex(bytes);
}

std::string encode_segment(const std::vector<Keyframe>& keyframes) {
  SegmentEncoder encoder;
  for (const Keyframe& keyframe : keyframes) encoder.add(keyframe);
  return encoder.take();
}

struct Sample {
  TrajectoryHeader header = sample_header();
  std::vector<Keyframe> keyframes = random_keyframes(3, header, Values::stored);
  std::string body = encode_segment(keyframes);
  std::uint64_t removed = 0;
  std::string bytes;

  Sample() {
    for (const Keyframe& keyframe : keyframes) removed += static_cast<std::uint64_t>(run_length(keyframe));
    bytes = file_with(header, keyframes.size(), body, removed);
  }
};

TEST(HostileBinary, TheUnchangedFileIsFine) {
  const Sample sample;
  EXPECT_EQ(read_all(sample.bytes), "");
  EXPECT_EQ(read_by_segments(sample.bytes), "");
}

TEST(HostileBinary, EveryTruncationIsNoticed) {
  const Sample sample;
  for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
    EXPECT_NE(read_all(sample.bytes.substr(0, size)), "") << size << " bytes";
    EXPECT_NE(read_by_segments(sample.bytes.substr(0, size)), "") << size << " bytes";
  }
}

TEST(HostileBinary, EveryChangedByteIsNoticed) {
  const Sample sample;
  Random random(1);
  for (std::size_t at = 0; at < sample.bytes.size(); ++at) {
    std::string bad = sample.bytes;
    bad[at] ^= static_cast<char>(1 + random.next() % 255);
    EXPECT_NE(read_all(bad), "") << "byte " << at;
    // Random access does not read the hash.
    EXPECT_EQ(read_by_segments(bad).empty(), at >= bad.size() - sha256_hex_bytes) << "byte " << at;
  }
  EXPECT_NE(read_all(sample.bytes + "x"), "");
}

TEST(HostileBinary, BodiesWithFittingChecksumsAreReadOrRefused) {
  const Sample sample;
  int fine = 0;
  for (std::uint64_t seed = 0; seed < 5000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::string body = sample.body;
    for (std::uint64_t count = 1 + random.next() % 3; count > 0; --count) {
      const std::size_t at = random.next() % body.size();
      if (random.next() % 2 == 0)
        body[at] = static_cast<char>(random.next());
      else if (random.next() % 2 == 0)
        body.erase(at, 1 + random.next() % 5);
      else
        body.insert(at, 1 + random.next() % 5, static_cast<char>(random.next()));
    }
    const std::string bytes = file_with(sample.header, sample.keyframes.size(), body, sample.removed);
    EXPECT_EQ(read_all(bytes), read_by_segments(bytes).empty() ? "" : read_all(bytes));
    fine += read_all(bytes).empty();
  }
  EXPECT_GT(fine, 0) << "a change that only moves a joint cannot be told from a plan";
}

TEST(HostileBinary, BodiesThatLieAreRefused) {
  TrajectoryHeader header = sample_header();
  const std::string no_joints("\0\0\0\0\0\0\0\0\0", 9);  // three joints of one keyframe: order 0, a zero, none more
  const auto token = [&](const std::string& cut) { return read_all(file_with(header, 1, cut + no_joints, 0)); };
  EXPECT_EQ(token(std::string(1, '\0')), "");
  EXPECT_NE(token("\xff\xff\xff\xff\xff\xff\xff\xff\xff\x01").find("longer than the grid"), std::string::npos);
  EXPECT_NE(token("\xff\xff\xff\xff\xff\xff\xff\xff\xff\x02").find("64 bits"), std::string::npos);
  EXPECT_NE(token("\x02").find("outside the grid"), std::string::npos) << "one step before voxel (0,0,0)";
  EXPECT_NE(token("\x08\xff\xff\xff\xff\xff\xff\xff\xff\xff\x01").find("outside the grid"), std::string::npos);

  const auto joint = [&](const std::string& column) {
    return read_all(file_with(header, 1, '\0' + column + no_joints.substr(3), 0));
  };
  EXPECT_NE(joint("\x04\x02").find("order"), std::string::npos);
  EXPECT_NE(joint(std::string("\0\0\x01", 3)).find("zeros"), std::string::npos);
  EXPECT_NE(joint("\1\xff\xff\xff\xff\xff\xff\xff\xff\xff\x01").find("out of range"), std::string::npos);
  EXPECT_NE(joint(std::string("\0\2\0", 3)).find("more than"), std::string::npos);
}

TEST(HostileBinary, SizesThatNoSegmentHasAreRefusedBeforeTheyAreAllocated) {
  const TrajectoryHeader header = sample_header();
  const auto with_head = [&](std::uint32_t keyframes, std::uint32_t size) {
    std::string bytes = preamble_bytes(header) + '\1';
    append_word(bytes, keyframes);
    append_word(bytes, std::uint64_t{0});
    append_word(bytes, size);
    append_word(bytes, std::uint32_t{0});
    return read_all(bytes);
  };
  EXPECT_NE(with_head(0, 0).find("keyframes"), std::string::npos);
  EXPECT_NE(with_head(4097, 10).find("keyframes"), std::string::npos);
  EXPECT_NE(with_head(0xffffffff, 10).find("keyframes"), std::string::npos);
  EXPECT_NE(with_head(1, 0xffffffff).find("cannot take"), std::string::npos);

  std::string header_bomb(binary_magic);
  append_word(header_bomb, binary_version);
  append_word(header_bomb, std::uint32_t{0xffffffff});
  EXPECT_NE(read_all(header_bomb).find("header"), std::string::npos);
}

TEST(HostileBinary, AnIndexThatDoesNotFitIsRefusedEvenWithFittingChecksums) {
  const Sample sample;
  const std::uint64_t first = preamble_bytes(sample.header).size(), count = sample.keyframes.size(),
                      removed = sample.removed;
  const SegmentBytes segment{sample.keyframes.size(), 0, sample.body};
  const std::string before = preamble_bytes(sample.header) + segment.head() + sample.body;
  const auto with_index = [&](const std::string& index) { return before + index + sha256_hex(before + index); };
  EXPECT_EQ(read_by_segments(with_index(index_bytes({{first, 0, 0}}, count, removed, before.size()))), "");
  for (const std::string& index :
       {index_bytes({}, count, removed, before.size()), index_bytes({{first + 1, 0, 0}}, count, removed, before.size()),
        index_bytes({{first, 1, 0}}, count, removed, before.size()),
        index_bytes({{first, 0, 1}}, count, removed, before.size()),
        index_bytes({{first, 0, 0}}, count + 1, removed, before.size()),
        index_bytes({{first, 0, 0}}, count, removed + 1, before.size()),
        index_bytes({{first, 0, 0}}, ~0ull, ~0ull, before.size()),
        index_bytes({{first, 0, 0}}, count, removed, before.size() + 1),
        index_bytes({{first, 0, 0}}, count, removed, ~0ull),
        index_bytes({{first, 0, 0}, {first, 1, 0}}, count, removed, before.size()),
        index_bytes({{first, 0, 0}, {~0ull, 1, 0}}, count, removed, before.size())}) {
    EXPECT_NE(read_all(with_index(index)), "");
    EXPECT_NE(read_by_segments(with_index(index)), "");
  }
}

TEST(HostileBinary, OtherVersionsAndOtherFilesAreRefused) {
  std::string bytes = Sample().bytes;
  bytes[8] = 1;
  EXPECT_NE(read_all(bytes).find("version 1"), std::string::npos);
  EXPECT_NE(read_all("SCULPTRX" + bytes.substr(8)).find("not an .sct"), std::string::npos);
  EXPECT_NE(read_by_segments(""), "");
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::string text = preamble_bytes(sample_header());
    for (std::uint64_t count = random.next() % 4000; count > 0; --count) text += static_cast<char>(random.next());
    EXPECT_NE(read_all(text), "");
    EXPECT_NE(read_by_segments(text), "");
  }
}

}  // namespace
}  // namespace sculpt
