// Whatever was done to the files of the store is noticed before anything is thrown away.
#include "server/ops/store_opening.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "server/files/store_mark.hpp"
#include "server/store/sqlite/store_facts.hpp"
#include "tests/server/temp_folder.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

class StoreOpeningTest : public testing::Test {
 protected:
  // Jobs, each with a folder; the last one is cancelled.
  void submit(int count) {
    const std::unique_ptr<JobStore> store = open_store(folder, {});
    for (int n = 0; n < count; ++n) {
      const std::string id = store->submit({{}, {}, "{}", "cell"}).job.id;
      fs::create_directories(folder.jobs() / id);
      std::ofstream(folder.jobs() / id / "trajectory.ndjson") << "a result";
      jobs.push_back(id);
    }
    store->cancel(jobs.back());
  }
  // A copy while a daemon runs, which may be killed now: the log is not yet in the database.
  void copy_with_log(const fs::path& to) {
    const std::unique_ptr<JobStore> store = open_store(folder, {});
    store->submit({{}, {}, "{}", "cell"});
    fs::create_directories(to);
    for (const char* file : {"sculptd.db", "sculptd.db-wal", "sculptd.mark"})
      fs::copy_file(folder.folder / file, to / file);
  }
  std::string refusal() {
    try {
      open_store(folder, {});
      return "opened";
    } catch (const StoreLost& error) {
      return error.what();
    }
  }
  void expect_refused(const std::string& word) {
    const auto before = listing();
    EXPECT_NE(refusal().find(word), std::string::npos) << refusal();
    EXPECT_NE(refusal().find("restore a backup"), std::string::npos) << refusal();
    EXPECT_NE(refusal().find("sculptd adopt"), std::string::npos) << refusal();
    EXPECT_EQ(listing(), before);
  }
  // All files with their sizes, but for SQLite's index of the log and an empty log, which are made by looking.
  std::map<std::string, std::uintmax_t> listing() const {
    std::map<std::string, std::uintmax_t> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder.folder))
      if (entry.is_regular_file() && entry.path().extension() != ".db-shm" &&
          (entry.path().extension() != ".db-wal" || entry.file_size() > 0)) {
        files[entry.path()] = entry.file_size();
      }
    return files;
  }

  TempFolder scratch;
  DataFolder folder{scratch.path() / "data"};
  std::vector<std::string> jobs;
};

TEST_F(StoreOpeningTest, AFreshFolderAndOneThatWasStoppedOrKilledAreOpened) {
  submit(3);
  EXPECT_EQ(refusal(), "opened");
  EXPECT_EQ(read_mark(folder.mark())->changes, 4u);
  copy_with_log(scratch.path() / "killed");
  const DataFolder killed(scratch.path() / "killed");
  EXPECT_NO_THROW(open_store(killed, {}));
}

TEST_F(StoreOpeningTest, AMissingOrEmptyDatabaseIsRefused) {
  submit(3);
  fs::resize_file(folder.database(), 0);
  expect_refused("is missing or empty");
  fs::remove(folder.database());
  expect_refused("is missing or empty");
  fs::remove(folder.mark());
  expect_refused("is missing or empty");
}

TEST_F(StoreOpeningTest, AnotherDatabaseIsRefused) {
  submit(2);
  fs::remove(folder.database());
  open_sqlite_store(folder.database());
  expect_refused("is another store");
}

TEST_F(StoreOpeningTest, AnOlderCopyIsRefusedAndTheFolderAsAWholeIsNot) {
  submit(2);
  fs::copy_file(folder.database(), scratch.path() / "old.db");
  fs::copy_file(folder.mark(), scratch.path() / "old.mark");
  submit(1);
  fs::copy_file(scratch.path() / "old.db", folder.database(), fs::copy_options::overwrite_existing);
  expect_refused("knows 3 changes of jobs, and 5 were acknowledged");
  fs::copy_file(scratch.path() / "old.mark", folder.mark(), fs::copy_options::overwrite_existing);
  EXPECT_EQ(refusal(), "opened");
}

TEST_F(StoreOpeningTest, ALogThatIsGoneOrCutAnywhereInsideIsRefused) {
  submit(2);
  const fs::path killed = scratch.path() / "killed";
  copy_with_log(killed);
  const std::uintmax_t whole = fs::file_size(killed / "sculptd.db-wal");
  for (const std::uintmax_t left : {std::uintmax_t{0}, whole / 2, whole - 1}) {
    const fs::path cut = scratch.path() / ("cut" + std::to_string(left));
    fs::copy(killed, cut);
    fs::resize_file(cut / "sculptd.db-wal", left);
    EXPECT_THROW(open_store(DataFolder(cut), {}), StoreLost) << left << " of " << whole;
    EXPECT_EQ(fs::file_size(cut / "sculptd.db-wal"), left) << "for whoever restores the rest";
  }
}

TEST_F(StoreOpeningTest, ADamagedDatabaseIsRefusedAndNotAdopted) {
  submit(50);
  {
    std::fstream file(folder.database(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(2 * 4096);
    file << std::string(4096, 'x');
  }
  expect_refused("is damaged");
  EXPECT_THROW(adopt_store(folder), StoreLost);
  std::ofstream(folder.database(), std::ios::trunc) << std::string(8192, 'x');
  expect_refused("is damaged");
}

TEST_F(StoreOpeningTest, AnAdoptedFolderGoesOnAndUnknownJobsArePutAside) {
  submit(3);
  fs::remove(folder.database());
  adopt_store(folder);
  EXPECT_EQ(refusal(), "opened");
  for (const std::string& job : jobs) {
    EXPECT_FALSE(fs::exists(folder.jobs() / job));
    EXPECT_TRUE(fs::exists(scratch.path() / "data/jobs.orphaned" / job / "trajectory.ndjson"));
  }
}

TEST_F(StoreOpeningTest, AStoreThatHasLostSomethingIsAdoptedUnderANewEpoch) {
  submit(2);
  const std::string epoch = read_store_facts(folder.database())->epoch;
  adopt_store(folder);
  EXPECT_EQ(read_store_facts(folder.database())->epoch, epoch) << "nothing was lost";
  fs::copy_file(folder.database(), scratch.path() / "old.db");
  submit(1);
  fs::copy_file(scratch.path() / "old.db", folder.database(), fs::copy_options::overwrite_existing);
  adopt_store(folder);
  const std::unique_ptr<JobStore> store = open_store(folder, {});
  EXPECT_NE(store->epoch(), epoch) << "clients must not take it for the one that they knew";
  EXPECT_TRUE(store->find(jobs[0]));
  EXPECT_TRUE(fs::exists(folder.jobs() / jobs[0]));
  EXPECT_FALSE(fs::exists(folder.jobs() / jobs[2]));
}

TEST_F(StoreOpeningTest, AnUnreadableMarkIsAdoptedToo) {
  submit(1);
  std::ofstream(folder.mark(), std::ios::trunc) << "nothing";
  expect_refused("cannot be read");
  adopt_store(folder);
  EXPECT_EQ(refusal(), "opened");
}

TEST_F(StoreOpeningTest, ADatabaseThatWasMadeBeforeThereWereMarksGetsOne) {
  submit(1);
  fs::remove(folder.mark());
  EXPECT_EQ(refusal(), "opened");
  EXPECT_TRUE(read_mark(folder.mark()));
}

}  // namespace
}  // namespace sculpt::server
