#include "core/material/binvox.hpp"

#include <gtest/gtest.h>

#include "tests/core/material/shapes.hpp"

namespace sculpt {
namespace {

Grid grid_of(int n) {
  return {n, 0.25 / n, Vec3(-0.125, -0.125, 0.1)};
}

std::string with_header(int n, const std::string& data) {
  const std::string edge = std::to_string(n);
  return "#binvox 1\ndim " + edge + " " + edge + " " + edge + "\ntranslate 0 0 0\nscale 1\ndata\n" + data;
}

/// 512 voxels of an 8^3 grid, all 0.
std::string empty_data() {
  return std::string("\0\xff\0\xff\0\x02", 6);
}

std::string refusal(const std::string& bytes) {
  EXPECT_EQ(shapes::error_code([&] { read_binvox(bytes); }), "binvox_invalid");
  return shapes::error_sentence([&] { read_binvox(bytes); });
}

TEST(Binvox, WhatIsWrittenIsReadBack) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const VoxelSet voxels = shapes::random_grid(8 << seed % 4, seed).keep;
    EXPECT_TRUE(read_binvox(write_binvox(voxels, grid_of(voxels.n()))) == voxels);
  }
  EXPECT_EQ(read_binvox(write_binvox(VoxelSet(64, true), grid_of(64))).size(), 64u * 64 * 64);
}

TEST(Binvox, YRunsFastestThenZThenX) {
  VoxelSet voxels(8);
  voxels.insert({2, 3, 1});  // at 2 * 64 + 1 * 8 + 3 = 139
  const std::string bytes = write_binvox(voxels, grid_of(8));
  const std::string data = bytes.substr(bytes.find("data\n") + 5);
  EXPECT_EQ(data, std::string("\0\x8b\x01\x01\0\xff\0\x75", 8));
}

TEST(Binvox, HeaderSaysWhereTheGridIs) {
  const std::string bytes = write_binvox(VoxelSet(8), grid_of(8));
  EXPECT_TRUE(bytes.starts_with("#binvox 1\ndim 8 8 8\ntranslate -0.125 -0.125 0.1")) << bytes.substr(0, 60);
  EXPECT_NE(bytes.find("\nscale 0.25\ndata\n"), std::string::npos) << bytes.substr(0, 90);
}

TEST(Binvox, HeaderMaySayHowLargeTheGridIs) {
  const BinvoxHeader header = read_binvox_header(write_binvox(VoxelSet(16), grid_of(16)));
  EXPECT_EQ(header.n, 16);
  EXPECT_EQ(header.size_m, 0.25);
  EXPECT_EQ(read_binvox_header("#binvox 1\ndim 8 8 8\ndata\n").size_m, std::nullopt);
}

TEST(Binvox, LinesMayEndInCarriageReturnAndComeInAnyOrder) {
  const std::string bytes = "#binvox 1\r\nscale 1\r\ndim 8 8 8\r\ndata\r\n" + empty_data();
  EXPECT_EQ(read_binvox(bytes).size(), 0u);
}

TEST(Binvox, RefusesHeadersThatMakeNoSense) {
  EXPECT_NE(refusal("").find("does not start with"), std::string::npos);
  EXPECT_NE(refusal("#binvox 2\ndim 8 8 8\ndata\n").find("version 1"), std::string::npos);
  EXPECT_NE(refusal("#binvox 1\ndim 8 8 8\n").find("\"data\""), std::string::npos);
  EXPECT_NE(refusal("#binvox 1\ndata\n").find("no line \"dim\""), std::string::npos);
  EXPECT_NE(refusal("#binvox 1\ndim 8 8\ndata\n").find("three whole numbers"), std::string::npos);
  EXPECT_NE(refusal("#binvox 1\ndim 8 8 16\ndata\n").find("not a cube"), std::string::npos);
  EXPECT_NE(refusal("#binvox 1\ndim 8 8 8\ncolour red\ndata\n").find("colour"), std::string::npos);
  for (int n : {-8, 0, 1, 4, 7, 100, 2048})
    EXPECT_NE(refusal(with_header(n, "")).find("or 1024 voxels"), std::string::npos) << n;
}

TEST(Binvox, RefusesDataThatDoNotFillTheGrid) {
  EXPECT_NE(refusal(with_header(8, "")).find("cut short"), std::string::npos);
  EXPECT_NE(refusal(with_header(8, empty_data().substr(0, 5))).find("cut short"), std::string::npos);
  EXPECT_NE(refusal(with_header(8, empty_data().substr(0, 4))).find("hold 510 voxels"), std::string::npos);
  EXPECT_NE(refusal(with_header(8, empty_data() + std::string("\x01\x01", 2))).find("more voxels"), std::string::npos);
  EXPECT_NE(refusal(with_header(8, std::string("\x07\xff", 2))).find("value 7"), std::string::npos);
  EXPECT_NE(refusal(with_header(8, std::string("\x01\0", 2))).find("length 0"), std::string::npos);
}

TEST(Binvox, RandomBytesAreRefusedOrReadButNeverCrash) {
  const std::string good = write_binvox(shapes::random_grid(16, 3).keep, grid_of(16));
  int refused = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Random random(seed);
    std::string bytes =
        good.substr(0, static_cast<std::size_t>(random.between(0, static_cast<double>(good.size() + 1))));
    for (int flip = 0; flip < 3 && !bytes.empty(); ++flip)
      bytes[static_cast<std::size_t>(random.between(0, static_cast<double>(bytes.size())))] =
          static_cast<char>(random.next());
    refused += !shapes::error_code([&] { read_binvox(bytes); }).empty();
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace sculpt
