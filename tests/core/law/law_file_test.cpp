#include "core/law/law_file.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "core/base/error.hpp"
#include "core/base/random.hpp"
#include "core/law/coarse.hpp"

namespace sculpt {
namespace {

TEST(Coarse, NumbersAreRoundedDownByLittleAndComeBack) {
  Random random(1);
  for (int round = 0; round < 100000; ++round) {
    const double value = std::ldexp(random.between(1, 2), static_cast<int>(random.between(-26, 6)));
    const double near = rounded_down(value);
    ASSERT_LE(near, value);
    ASSERT_GE(near, value * (1 - 1.0 / 2048)) << value;
    ASSERT_EQ(rounded_down(near), near);
    ASSERT_EQ(static_cast<double>(static_cast<float>(near)), near);
  }
  EXPECT_EQ(rounded_down(0), 0);
  EXPECT_EQ(rounded_down(-1), 0);
  EXPECT_EQ(rounded_down(std::ldexp(1, -27)), 0);
  EXPECT_LE(rounded_down(1e9), 64);
}

LawFile random_law(Random& random) {
  LawFile file;
  const std::size_t joints = 1 + random.next() % 8;
  for (std::size_t at = 0; at < joints; ++at) file.law.acceleration.push_back(random.between(0.1, 20));
  file.law.window_s = random.between(0, 0.1);
  file.law.feed_m_s = 0.05;
  file.law.rapid_m_s = 0.5;
  for (std::size_t left = random.next() % 10000; left > 0; --left) {
    file.law.corners.push_back({static_cast<float>(rounded_down(random.between(0, 1e-3))),
                                static_cast<float>(rounded_down(random.between(0, 1))),
                                static_cast<float>(random.between(0, 1)), static_cast<float>(random.between(0, 1)), 0});
    file.plan.add(Configuration::Constant(static_cast<Eigen::Index>(joints), random.between(-1, 1)));
  }
  return file;
}

std::string bytes_of(const LawFile& file) {
  std::ostringstream out;
  write_law(out, file.law, file.plan);
  return out.str();
}

std::string refusal(const std::string& bytes) {
  std::istringstream in(bytes);
  try {
    read_law(in);
    return "accepted";
  } catch (const InputError& error) {
    return error.code() + ": " + error.what();
  }
}

TEST(LawFile, WhatIsWrittenIsReadInSixteenBytesAKeyframe) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const LawFile file = random_law(random);
    const std::string bytes = bytes_of(file);
    EXPECT_LE(bytes.size(), 16 * file.law.corners.size() + 300);
    std::istringstream in(bytes);
    const LawFile read = read_law(in);
    EXPECT_EQ(read.plan, file.plan);
    EXPECT_EQ(read.law.acceleration, file.law.acceleration);
    EXPECT_EQ(read.law.window_s, file.law.window_s);
    EXPECT_EQ(bytes_of(read), bytes);
  }
}

TEST(LawFile, CutOrDamagedFilesAreRefused) {
  Random random(3);
  LawFile file = random_law(random);
  file.law.corners.resize(50);
  file.plan.keyframes = 50;
  const std::string bytes = bytes_of(file);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_TRUE(refusal(bytes.substr(0, size)).starts_with("law_invalid: ")) << size;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 1 << at % 8);
    ASSERT_TRUE(refusal(damaged).starts_with("law_invalid: ")) << at;
  }
  EXPECT_NE(refusal(bytes + "x").find("more bytes"), std::string::npos);
}

TEST(LawFile, APlanIsKnownByItsKeyframes) {
  PlanMark one, other;
  one.add(Configuration::Constant(2, 0.5));
  other.add(Configuration::Constant(2, 0.5000001));
  EXPECT_NE(one, other);
}

}  // namespace
}  // namespace sculpt
