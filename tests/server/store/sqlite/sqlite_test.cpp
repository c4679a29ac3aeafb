// Statements are prepared once for all their uses: no use may see what another left behind.
#include "server/store/sqlite/sqlite.hpp"

#include <gtest/gtest.h>

#include "server/base/storage_error.hpp"
#include "tests/server/temp_folder.hpp"

namespace sculpt::server {
namespace {

class Statements : public testing::Test {
 protected:
  Statements() { database_.run("CREATE TABLE word(text TEXT UNIQUE); INSERT INTO word VALUES('a'), ('b')"); }

  std::string first_word() { return first(Statement(database_, words)); }
  static std::string first(Statement statement) { return statement.step() ? statement.text(0) : "none"; }

  static constexpr const char* words = "SELECT text FROM word ORDER BY text";
  TempFolder folder_;
  Database database_{folder_.path() / "words.db"};
};

TEST_F(Statements, BeginAnewAtEachUse) {
  EXPECT_EQ(first_word(), "a");
  EXPECT_EQ(first_word(), "a");
}

TEST_F(Statements, OfOneTextAreReadSideBySide) {
  Statement one(database_, words), other(database_, words);
  ASSERT_TRUE(one.step());
  ASSERT_TRUE(one.step());
  ASSERT_TRUE(other.step());
  EXPECT_EQ(one.text(0), "b");
  EXPECT_EQ(other.text(0), "a");
}

TEST_F(Statements, DoNotKeepWhatWasBoundBefore) {
  constexpr const char* echo = "SELECT coalesce(?, 'nothing')";
  EXPECT_EQ(first(std::move(Statement(database_, echo).bind("something"))), "something");
  EXPECT_EQ(first(Statement(database_, echo)), "nothing");
}

TEST_F(Statements, OfWhichOneFailedRunAgain) {
  constexpr const char* add = "INSERT INTO word VALUES(?)";
  EXPECT_THROW(Statement(database_, add).bind("a").run(), StorageError);
  EXPECT_EQ(Statement(database_, add).bind("0").run(), 1);
  EXPECT_EQ(first_word(), "0");
}

TEST_F(Statements, FollowAChangeOfTheTable) {
  constexpr const char* all = "SELECT * FROM word ORDER BY text";
  EXPECT_EQ(first(Statement(database_, all)), "a");
  database_.run("DROP TABLE word; CREATE TABLE word(number INTEGER, text TEXT); INSERT INTO word VALUES(7, 'seven')");
  EXPECT_EQ(first(Statement(database_, all)), "7");
}

TEST_F(Statements, ThatAreLeftHalfReadHoldNoLock) {
  { ASSERT_TRUE(Statement(database_, words).step()); }
  Database other(folder_.path() / "words.db");
  EXPECT_NO_THROW(other.run("DROP TABLE word"));
}

}  // namespace
}  // namespace sculpt::server
