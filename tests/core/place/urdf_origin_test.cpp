#include "core/place/urdf_origin.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

TEST(UrdfOrigin, OnlyTheNumbersOfThatOriginChange) {
  const std::string before =
      "<robot name='r'><!-- <joint name=\"a\" type=\"fixed\"><origin xyz='9 9 9'/></joint> -->\n"
      "<transmission><joint name='a'><origin xyz='8 8 8'/></joint></transmission>\n"
      "<joint type=\"fixed\" name=\"a\">\n  <parent link=\"x\"/> <origin rpy='0.1 0 0.2' xyz='1 2 3' />\n</joint>"
      "<joint name=\"b\" type=\"fixed\"><origin xyz=\"4 5 6\"/></joint></robot>";
  std::string expected = before;
  const std::string old = "<origin rpy='0.1 0 0.2' xyz='1 2 3' />";
  expected.replace(expected.find(old), old.size(), "<origin xyz=\"0.5 0 -1\" rpy=\"0.1 0 0.2\"/>");
  EXPECT_EQ(move_origin(before, "a", {0.5, 0, -1}, 0), expected);
}

TEST(UrdfOrigin, ATurnIsAddedToTheYaw) {
  const std::string text = "<joint name=\"a\" type=\"fixed\"><origin xyz=\"1 2 3\" rpy=\"0.1 0.2 0.25\"/></joint>";
  EXPECT_EQ(move_origin(text, "a", {1, 2, 3}, 0.5),
            "<joint name=\"a\" type=\"fixed\"><origin xyz=\"1 2 3\" rpy=\"0.1 0.2 0.75\"/></joint>");
}

TEST(UrdfOrigin, AJointWithoutOneGetsOne) {
  EXPECT_EQ(move_origin("<joint name=\"a\" type=\"fixed\"><parent link=\"x\"/></joint>", "a", {1, 2, 3}, 0),
            "<joint name=\"a\" type=\"fixed\"><origin xyz=\"1 2 3\"/><parent link=\"x\"/></joint>");
}

TEST(UrdfOrigin, WhatIsNotThereIsRefused) {
  EXPECT_THROW(move_origin("<robot/>", "a", {0, 0, 0}, 0), InputError);
  EXPECT_THROW(move_origin("<joint name=\"a\" type=\"fixed\">", "a", {0, 0, 0}, 0), InputError);
  EXPECT_THROW(move_origin("<!-- <joint name=\"a\"", "a", {0, 0, 0}, 0), InputError);
}

}  // namespace
}  // namespace sculpt
