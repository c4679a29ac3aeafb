#include "core/trajectory/text/plain_line.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/trajectory/text/trajectory_line.hpp"
#include "tests/core/trajectory/random_trajectory.hpp"

namespace sculpt {
namespace {

std::string line_of(const Keyframe& keyframe) {
  const TrajectoryHeader header = sample_header();
  std::vector<char> out(max_keyframe_line_bytes(header));
  return {out.data(), write_keyframe_line(out.data(), keyframe, header) - 1};
}

std::optional<Keyframe> parsed(const std::string& text, const TrajectoryHeader& header) {
  try {
    TrajectoryLine line = parse_line(text, header, "line");
    if (!line.is_end) return std::move(line.keyframe);
  } catch (const InputError&) {
  }
  return {};
}

bool same(const Keyframe& a, const Keyframe& b) {
  for (Eigen::Index at = 0; at < a.q.size(); ++at)
    if (std::bit_cast<std::uint64_t>(a.q[at]) != std::bit_cast<std::uint64_t>(b.q[at])) return false;
  return a.q.size() == b.q.size() && a.cut == b.cut && a.first == b.first && a.last == b.last;
}

TEST(PlainLine, ReadsWhatPlannersWrite) {
  const TrajectoryHeader header = sample_header();
  Random random(1);
  for (int n = 0; n < 10000; ++n) {
    Keyframe keyframe = random_keyframe(random, header);
    for (double& value : keyframe.q)
      value = from_quanta(static_cast<std::int64_t>(random.next() >> (38 + random.next() % 26)));
    const auto read = read_plain_line(line_of(keyframe), header);
    ASSERT_TRUE(read) << line_of(keyframe);
    EXPECT_TRUE(same(*read, keyframe)) << line_of(keyframe);
  }
}

TEST(PlainLine, NeverSaysOtherThanTheParser) {
  const TrajectoryHeader header = sample_header();
  const std::string bytes = "0123456789.,-+eE[]{}\" \ttypecutmovq:";
  int plain = 0;
  for (std::uint64_t seed = 0; seed < 100000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::string text = line_of(random_keyframe(random, header, seed % 4 == 0 ? Values::any : Values::stored));
    for (std::uint64_t count = random.next() % 3; count > 0; --count) {
      const std::size_t at = random.next() % text.size();
      const char byte = bytes[random.next() % bytes.size()];
      if (random.next() % 3 == 0)
        text.erase(at, 1);
      else if (random.next() % 2 == 0)
        text.insert(at, 1, byte);
      else
        text[at] = byte;
    }
    const auto read = read_plain_line(text, header);
    if (!read) continue;
    ++plain;
    const auto expected = parsed(text, header);
    ASSERT_TRUE(expected) << text;
    ASSERT_TRUE(same(*read, *expected)) << text;
  }
  EXPECT_GT(plain, 1000);
}

TEST(PlainLine, LeavesTheUnusualToTheParser) {
  TrajectoryHeader header = sample_header();
  header.joints = {"a"};
  const auto plain = [&](const std::string& value) {
    return read_plain_line(R"({"type":"move","q":[)" + value + "]}", header).has_value();
  };
  for (const char* value : {"0", "1", "-1.5", "0.0000001", "12345678.1234567", "1e-07", "1.5e-06", "-9.99e-05"})
    EXPECT_TRUE(plain(value)) << value;
  for (const char* value : {"-0",   "00",  "01",         "1.",        ".5", "+1", "1e5", "1e-08", "1.5e-07", "1e-10",
                            "1e-0", "1e-", "0.12345678", "123456789", "",   "-",  "1 ",  "1,2",   "null",    "-0.0"})
    EXPECT_FALSE(plain(value)) << value;
}

}  // namespace
}  // namespace sculpt
