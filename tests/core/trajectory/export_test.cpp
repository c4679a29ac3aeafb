#include "core/trajectory/export.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "random_trajectory.hpp"

namespace sculpt {
namespace {

std::string to_binary(const std::string& ndjson) {
  std::istringstream in(ndjson);
  std::ostringstream out;
  export_binary(in, out);
  return out.str();
}

std::string from_binary(const std::string& sct) {
  std::istringstream in(sct);
  std::ostringstream out;
  import_binary(in, out);
  return out.str();
}

TEST(Export, BinaryAndBackGivesTheSameBytes) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TrajectoryHeader header = sample_header();
    const std::string text = write_text(header, random_keyframes(seed, header));
    EXPECT_EQ(from_binary(to_binary(text)), text);
  }
}

TEST(Export, BinaryHasTheDocumentedLayout) {
  const TrajectoryHeader header = sample_header();
  const std::string text = write_text(header, {{Configuration::Constant(3, 1.0), true, {1, 2, 3}, {1, 2, 15}}});
  const std::string sct = to_binary(text);
  const std::string header_text = text.substr(0, text.find('\n'));
  const std::string one("\0\0\0\0\0\0\xf0\x3f", 8);  // 1.0 as f64
  const std::string expected = "SCULPTRJ" + std::string("\1\0\0\0", 4) + static_cast<char>(header_text.size() & 0xff) +
                               static_cast<char>(header_text.size() >> 8) + std::string(2, '\0') + header_text + '\1' +
                               std::string("\1\0\0\0\2\0\0\0\3\0\0\0\1\0\0\0\2\0\0\0\xf\0\0\0", 24) + one + one + one +
                               '\2' + std::string("\1\0\0\0\0\0\0\0", 8);
  EXPECT_EQ(sct.substr(0, expected.size()), expected);
  EXPECT_EQ(sct.size(), expected.size() + 64);
}

TEST(Export, DamagedBinaryIsRefused) {
  const TrajectoryHeader header = sample_header();
  const std::string sct = to_binary(write_text(header, random_keyframes(3, header)));
  ASSERT_GT(sct.size(), 1000u);
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::string bad = sct;
    switch (seed % 3) {
      case 0:
        bad[random.next() % bad.size()] ^= static_cast<char>(1 + random.next() % 255);
        break;
      case 1:
        bad.resize(random.next() % bad.size());
        break;
      default:
        bad += static_cast<char>(random.next());
        break;
    }
    EXPECT_THROW(from_binary(bad), InputError);
  }
}

TEST(Export, CsvHasNamedColumnsAndOneRowAKeyframe) {
  const TrajectoryHeader header = sample_header();
  std::istringstream in(write_text(header, {{Configuration::Constant(3, 0.5), false, {}, {}},
                                            {Configuration::Constant(3, -0.25), true, {1, 2, 3}, {1, 2, 4}}}));
  std::ostringstream out;
  export_csv(in, out);
  std::istringstream csv(out.str());
  std::string line;
  std::vector<std::string> rows;
  int comments = 0;
  while (std::getline(csv, line)) {
    if (line[0] == '#') {
      ++comments;
    } else {
      rows.push_back(line);
    }
  }
  EXPECT_GE(comments, 1);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0],
            "type,slide,\"panda \"\"joint\"\", 2\",gr\xc3\xbc\xc3\x9f,first_i,first_j,first_k,last_i,last_j,last_k");
  EXPECT_EQ(rows[1], "move,0.5,0.5,0.5,,,,,,");
  EXPECT_EQ(rows[2], "cut,-0.25,-0.25,-0.25,1,2,3,1,2,4");
}

TEST(Export, AnUnfinishedTrajectoryIsRefused) {
  const TrajectoryHeader header = sample_header();
  std::string text = write_text(header, {});
  text.resize(text.find('\n') + 1);
  std::istringstream in(text), again(text);
  std::ostringstream out;
  EXPECT_THROW(export_csv(in, out), InputError);
  EXPECT_THROW(export_binary(again, out), InputError);
}

}  // namespace
}  // namespace sculpt
