#include "proto/motion/program_spec.hpp"

#include <gtest/gtest.h>

namespace sculpt::proto {
namespace {

TEST(ProgramSpec, ComesBackAsItWasWritten) {
  const Json full{{"dialect", "krl"},
                  {"name", "bust"},
                  {"motion", {{"feed_m_s", 0.05}, {"rapid_m_s", 0.4}, {"keep_feed", 0.9}}},
                  {"part_keyframes", 5000},
                  {"part_bytes", 1000000},
                  {"stock_files", true},
                  {"seams_in_stock", true}};
  EXPECT_EQ(to_json(read_program({full, ""})), full);
}

TEST(ProgramSpec, EqualSpecsGiveEqualText) {
  const Json short_one{{"dialect", "krl"}},
      long_one{{"dialect", "krl"}, {"name", "sculpt"}, {"motion", {{"rapid_m_s", 0.5}}}, {"seams_in_stock", false}};
  EXPECT_EQ(to_json(read_program({long_one, ""})), short_one);
  EXPECT_EQ(write_json(to_json(read_program({short_one, ""}))), write_json(short_one));
}

TEST(ProgramSpec, WhatIsNoneIsRefusedWithItsPlace) {
  const auto pointer = [](const Json& json) {
    try {
      read_program({json, "/params/program"});
      return std::string("accepted");
    } catch (const ProtocolError& error) {
      return error.pointer();
    }
  };
  EXPECT_EQ(pointer({{"name", "bust"}}), "/params/program/dialect");
  EXPECT_EQ(pointer({{"dialect", ""}}), "/params/program/dialect");
  EXPECT_EQ(pointer({{"dialect", "krl"}, {"part_bytes", -1}}), "/params/program/part_bytes");
  EXPECT_EQ(pointer({{"dialect", "krl"}, {"motion", {{"feed", 1}}}}), "/params/program/motion/feed");
  EXPECT_EQ(pointer({{"dialect", "krl"}, {"feed_m_s", 1}}), "/params/program/feed_m_s");
}

}  // namespace
}  // namespace sculpt::proto
