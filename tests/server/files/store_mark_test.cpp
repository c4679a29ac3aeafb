#include "server/files/store_mark.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/server/temp_folder.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

class StoreMarkTest : public testing::Test {
 protected:
  std::string text() const {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  void write(const std::string& bytes) const { std::ofstream(file, std::ios::binary) << bytes; }

  TempFolder folder;
  const fs::path file = folder.path() / "sculptd.mark";
};

TEST_F(StoreMarkTest, WhatWasRaisedLastIsRead) {
  EXPECT_FALSE(read_mark(file));
  MarkFile mark(file, "STORE");
  EXPECT_EQ(read_mark(file)->changes, 0u);
  for (const std::uint64_t changes : {1u, 2u, 7u, 4'000'000'000u}) {
    mark.raise(changes);
    EXPECT_EQ(read_mark(file)->changes, changes);
    EXPECT_EQ(read_mark(file)->store, "STORE");
  }
  MarkFile again(file, "STORE");
  EXPECT_EQ(read_mark(file)->changes, 4'000'000'000u);
}

TEST_F(StoreMarkTest, AnyLineThatIsDamagedLeavesTheOther) {
  {
    MarkFile mark(file, "STORE");
    mark.raise(41);
    mark.raise(42);
  }
  const std::string good = text();
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string damaged = good;
    damaged[at] ^= 1;
    write(damaged);
    const std::uint64_t changes = read_mark(file)->changes;
    EXPECT_TRUE(changes == 41 || changes == 42) << damaged;
  }
}

TEST_F(StoreMarkTest, OneWithoutAGoodLineIsRefusedWithItsCure) {
  for (const char* bytes : {"", "nothing\n", "sculptd-mark 1 store S changes 00000000000000000009 check 00000000\n"}) {
    write(bytes);
    try {
      read_mark(file);
      ADD_FAILURE() << bytes;
    } catch (const StoreLost& error) {
      EXPECT_NE(std::string(error.what()).find("sculptd adopt"), std::string::npos);
    }
  }
}

TEST_F(StoreMarkTest, ALinkIsNotWrittenThrough) {
  const fs::path elsewhere = folder.path() / "elsewhere";
  write_mark(elsewhere, {"STORE", 3});
  fs::create_symlink(elsewhere, file);
  EXPECT_ANY_THROW(MarkFile(file, "STORE"));
  EXPECT_EQ(read_mark(elsewhere)->changes, 3u);
}

}  // namespace
}  // namespace sculpt::server
