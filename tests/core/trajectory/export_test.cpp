#include "core/trajectory/export.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/trajectory/header.hpp"
#include "tests/core/trajectory/random_trajectory.hpp"

namespace sculpt {
namespace {

std::string to_binary(const std::string& ndjson) {
  std::istringstream in(ndjson);
  std::ostringstream out;
  export_binary(in, out);
  return out.str();
}

std::string to_text(const std::string& bytes) {
  std::istringstream in(bytes);
  std::ostringstream out;
  export_text(in, out);
  return out.str();
}

std::string to_csv(const std::string& bytes) {
  std::istringstream in(bytes);
  std::ostringstream out;
  export_csv(in, out);
  return out.str();
}

TEST(Export, BinaryAndBackGivesTheSameBytes) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TrajectoryHeader header = sample_header();
    const std::string text = write_text(header, random_keyframes(seed, header, Values::stored));
    EXPECT_EQ(to_text(to_binary(text)), text);
  }
}

TEST(Export, EveryFormMayBeTheInput) {
  const TrajectoryHeader header = sample_header();
  const std::string text = write_text(header, random_keyframes(2, header, Values::stored));
  const std::string sct = to_binary(text);
  EXPECT_EQ(to_binary(sct), sct);
  EXPECT_EQ(to_text(text), text);
  EXPECT_EQ(to_csv(sct), to_csv(text));
}

TEST(Export, JointValuesBetweenTheQuantaAreRefusedForBinary) {
  const std::string text = write_text(sample_header(), {{Configuration::Constant(3, 1.00000001), false, {}, {}}});
  try {
    to_binary(text);
    FAIL() << "1.00000001 is no multiple of 1e-7";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), "trajectory_invalid");
    EXPECT_NE(std::string(error.what()).find("1.00000001"), std::string::npos) << error.what();
  }
}

TEST(Export, CsvHasNamedColumnsAndOneRowAKeyframe) {
  const TrajectoryHeader header = sample_header();
  std::istringstream csv(to_csv(write_text(header, {{Configuration::Constant(3, 0.5), false, {}, {}},
                                                    {Configuration::Constant(3, -0.25), true, {1, 2, 3}, {1, 2, 4}}})));
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
  EXPECT_THROW(to_csv(text), InputError);
  EXPECT_THROW(to_binary(text), InputError);
  EXPECT_THROW(to_text(text), InputError);
}

}  // namespace
}  // namespace sculpt
