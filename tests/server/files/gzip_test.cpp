#include "server/files/gzip.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "core/base/random.hpp"

namespace sculpt::server {
namespace {

std::string packed(const std::string& plain) {
  std::istringstream in(plain);
  std::ostringstream out;
  write_gzip(in, out);
  return out.str();
}

TEST(Gzip, GivesBackWhatWentIn) {
  Random random(7);
  for (const std::size_t size : {0u, 1u, 65535u, 65536u, 65537u, 500000u}) {
    std::string noise(size, '\0');
    for (char& byte : noise) byte = static_cast<char>(random.next());
    EXPECT_EQ(read_gzip(packed(noise)), noise) << size;
    EXPECT_EQ(read_gzip(packed(std::string(size, 'x'))), std::string(size, 'x')) << size;
  }
  EXPECT_LT(packed(std::string(500000, 'x')).size(), 1000u);
}

TEST(Gzip, WhatIsCutShortOrNoneIsRefused) {
  const std::string good = packed("a sculpture");
  EXPECT_THROW(read_gzip(good.substr(0, good.size() - 1)), std::runtime_error);
  EXPECT_THROW(read_gzip("no gzip"), std::runtime_error);
  EXPECT_THROW(read_gzip(""), std::runtime_error);
}

}  // namespace
}  // namespace sculpt::server
