
#include <gtest/gtest.h>

#include <bit>

#include "core/base/error.hpp"
#include "core/base/sha256.hpp"
#include "core/trajectory/header.hpp"
#include "core/trajectory/keyframe.hpp"
#include "core/trajectory/quantum.hpp"
#include "core/trajectory/reader.hpp"
#include "core/trajectory/trajectory_start.hpp"
#include "core/trajectory/writer.hpp"
#include "tests/core/trajectory/random_trajectory.hpp"

namespace sculpt {
namespace {

bool same_bits(const Configuration& a, const Configuration& b) {
  if (a.size() != b.size()) return false;
  for (Eigen::Index at = 0; at < a.size(); ++at)
    if (std::bit_cast<std::uint64_t>(a[at]) != std::bit_cast<std::uint64_t>(b[at])) return false;
  return true;
}

TEST(Trajectory, LinesHaveTheDocumentedForm) {
  TrajectoryHeader header;
  header.joints = {"x", "y"};
  header.home = Eigen::Vector2d(0, -0.5);
  header.grid = {8, 0.01, Vec3(0, 0.25, -1)};
  header.tool = {0.0045, 0.004, 0.2};
  header.tolerance_m = 0.0002;
  header.cell = "gantry";
  header.search = "octree";
  header.seed = 7;
  const Keyframe move{Eigen::Vector2d(0.1, 1e-9), false, {}, {}};
  const Keyframe cut{Eigen::Vector2d(3, -2.123456789), true, {0, 1, 7}, {0, 1, 4}};
  const std::string body =
      R"({"type":"header","format":1,"joints":["x","y"],"home":[0,-0.5],"resolution":8,"voxel_m":0.01,"origin_m":[0,0.25,-1],)"
      R"("tool":{"ball_radius_m":0.0045,"shank_radius_m":0.004,"stickout_m":0.2},"tolerance_m":2e-04,"cell":"gantry","search":"octree","seed":7})"
      "\n"
      R"({"type":"move","q":[0.1,1e-09]})"
      "\n"
      R"({"type":"cut","q":[3,-2.123456789],"voxels":[[0,1,7],[0,1,4]]})"
      "\n";
  EXPECT_EQ(write_text(header, {move, cut}),
            body + R"({"type":"end","keyframes":2,"removed":4,"sha256":")" + sha256_hex(body) + "\"}\n");
}

TEST(Trajectory, ComesBackBitForBit) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TrajectoryHeader header = sample_header();
    const std::vector<Keyframe> keyframes = random_keyframes(seed, header);
    std::istringstream in(write_text(header, keyframes));
    TrajectoryReader reader(in);
    EXPECT_EQ(reader.header().joints, header.joints);
    EXPECT_TRUE(same_bits(reader.header().home, header.home));
    EXPECT_EQ(reader.header().grid.n, header.grid.n);
    EXPECT_EQ(reader.header().grid.voxel_m, header.grid.voxel_m);
    EXPECT_EQ(reader.header().grid.origin_m, header.grid.origin_m);
    EXPECT_EQ(reader.header().tool.ball_radius_m, header.tool.ball_radius_m);
    EXPECT_EQ(reader.header().tool.shank_radius_m, header.tool.shank_radius_m);
    EXPECT_EQ(reader.header().tool.stickout_m, header.tool.stickout_m);
    EXPECT_EQ(reader.header().seed, header.seed);
    std::uint64_t line = 1;
    for (const Keyframe& expected : keyframes) {
      const auto keyframe = reader.next();
      ASSERT_TRUE(keyframe);
      EXPECT_EQ(reader.line(), ++line);
      EXPECT_TRUE(same_bits(keyframe->q, expected.q));
      EXPECT_EQ(keyframe->cut, expected.cut);
      if (!expected.cut) continue;
      EXPECT_EQ(keyframe->first, expected.first);
      EXPECT_EQ(keyframe->last, expected.last);
    }
    EXPECT_FALSE(reader.next());
    EXPECT_FALSE(reader.next());
  }
}

TEST(Trajectory, SameKeyframesGiveTheSameBytes) {
  const TrajectoryHeader header = sample_header();
  EXPECT_EQ(write_text(header, random_keyframes(5, header)), write_text(header, random_keyframes(5, header)));
  EXPECT_NE(write_text(header, random_keyframes(5, header)), write_text(header, random_keyframes(6, header)));
}

TEST(Trajectory, EachKeyframeIsInTheStreamAsSoonAsItIsAdded) {
  const TrajectoryHeader header = sample_header();
  std::ostringstream out;
  TrajectoryWriter writer(out, header);
  Random random(1);
  for (int lines = 1; lines < 10; ++lines) {
    const std::string text = out.str();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), lines);
    writer.add(random_keyframe(random, header));
  }
}

TEST(Rounded, IsWithinHalfAQuantumAndStaysWhatItIs) {
  Random random(3);
  for (int n = 0; n < 100000; ++n) {
    const Configuration q = Configuration::Constant(1, random.between(-100, 100));
    const Configuration once = rounded(q);
    EXPECT_NEAR(once[0], q[0], 0.5e-7 + 1e-14);
    EXPECT_TRUE(same_bits(rounded(once), once));
  }
}

TEST(Rounded, StaysWithinLimitsThatAreNoMultiples) {
  Random random(5);
  for (int n = 0; n < 100000; ++n) {
    const double lower = random.between(-7, 7), upper = lower + random.between(1e-7, 2e-7);
    const double value = n % 3 == 0 ? lower : n % 3 == 1 ? upper : random.between(lower, upper);
    const auto one = [](double x) { return Configuration::Constant(1, x); };
    const double stored = rounded(one(value), one(lower), one(upper))[0];
    EXPECT_GE(stored, lower);
    EXPECT_LE(stored, upper);
    EXPECT_LT(std::abs(stored - value), 1e-7 + 1e-14);
    EXPECT_EQ(rounded(one(stored))[0], stored);
  }
}

TEST(Rounded, ALimitThatIsAMultipleCanBeReached) {
  const auto one = [](double x) { return Configuration::Constant(1, x); };
  EXPECT_EQ(rounded(one(-2.8973), one(-2.8973), one(2.8973))[0], -2.8973);
  EXPECT_EQ(rounded(one(2.8973), one(-2.8973), one(2.8973))[0], 2.8973);
  EXPECT_EQ(rounded(one(M_PI), one(-M_PI), one(M_PI))[0], 3.1415926);
}

TEST(Rounded, TextHasAtMostSevenDecimals) {
  Random random(4);
  const TrajectoryHeader header = sample_header();
  for (int n = 0; n < 1000; ++n) {
    const Keyframe keyframe{rounded(Configuration::Constant(3, random.between(1, 7))), false, {}, {}};
    const std::string text = write_text(header, {keyframe});
    const std::size_t at = text.find("\"q\":[") + 5;
    EXPECT_LE(text.find(',', at) - at, 9u) << text.substr(at, 30);
  }
}

TEST(Rounded, HasNoNegativeZero) {
  EXPECT_FALSE(std::signbit(rounded(Configuration::Constant(1, -1e-12))[0]));
}

TEST(RunLength, CountsTheVoxelsOfACut) {
  EXPECT_EQ(run_length({Configuration(), false, {}, {}}), 0);
  EXPECT_EQ(run_length({Configuration(), true, {1, 2, 3}, {1, 2, 3}}), 1);
  EXPECT_EQ(run_length({Configuration(), true, {1, 2, 9}, {1, 2, 3}}), 7);
}

TEST(TrajectoryWriter, RefusesValuesThatAreNotNumbers) {
  std::ostringstream out;
  TrajectoryWriter writer(out, sample_header());
  EXPECT_THROW(writer.add({Configuration::Constant(3, std::nan("")), false, {}, {}}), std::invalid_argument);
}

TEST(Trajectory, WhatIsWrittenSoFarIsKnownByLengthAndHash) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TrajectoryHeader header = sample_header();
    std::ostringstream out;
    TrajectoryWriter writer(out, header);
    std::uint64_t keyframes = 0;
    for (const Keyframe& keyframe : random_keyframes(seed, header)) {
      const TrajectoryStart start = writer.so_far();
      EXPECT_EQ(start.keyframes, keyframes++);
      EXPECT_EQ(start.bytes, out.str().size());
      EXPECT_EQ(start.sha256, sha256_hex(out.str()));
      writer.add(keyframe);
    }
    writer.finish();
    EXPECT_EQ(out.str(), write_text(header, random_keyframes(seed, header))) << "asking changes nothing";
  }
}

}  // namespace
}  // namespace sculpt
