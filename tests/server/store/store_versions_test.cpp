// Databases that daemons of other versions left.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "server/store/sqlite/sqlite.hpp"
#include "tests/server/store/job_store_fixture.hpp"

namespace sculpt::server {
namespace {

class StoreVersions : public JobStoreTest {
 protected:
  void SetUp() override { SCULPT_SQLITE_ONLY(); }
  /// Puts a database that a daemon of an older version left in the place of the store's.
  void load(const std::string& sql_file) {
    store.reset();
    std::filesystem::remove(file());
    std::ifstream sql(std::filesystem::path(SOURCE_DIR) / "tests/server/store" / sql_file);
    const std::string text{std::istreambuf_iterator<char>(sql), std::istreambuf_iterator<char>()};
    Database(file()).run(text.c_str());
  }
};

TEST_F(StoreVersions, ADatabaseOfVersion1IsBroughtUpToDate) {
  load("store_version_1.sql");
  for (int opened = 0; opened < 2; ++opened) {
    reopen();
    EXPECT_EQ(store->epoch(), "01M7Z88KGJBTZDB219QR92F322");
    EXPECT_EQ(store->list({}).jobs.size(), 5u);
  }
  const std::string done = "01M7Z88KKC6557GD2AF0NKGAC8", running = "01M7Z88KPZZPQKQ83NYNXV44VP";
  EXPECT_EQ(store->artifacts(done).size(), 4u);
  EXPECT_EQ(store->find_key("order 2")->schedule.priority, 5);
  EXPECT_EQ(store->last_event(done), 3u);
  EXPECT_EQ(store->recover(), 1);
  EXPECT_EQ(store->claim()->id, store->find_key("order 2")->id) << "five steps of priority, two seconds later";
  const JobRecord suspect = *store->claim();
  EXPECT_EQ(suspect.id, running);
  EXPECT_TRUE(suspect.isolated) << "it ran in the daemon that was killed";
  EXPECT_EQ(store->claim()->id, store->find_key("order 1")->id);
}

TEST_F(StoreVersions, ADatabaseOfVersion2IsBroughtUpToDate) {
  load("store_version_2.sql");
  for (int opened = 0; opened < 2; ++opened) {
    reopen();
    EXPECT_EQ(store->epoch(), "01M7ZD1DA5WTXE4BBXGP8TXEHG");
    EXPECT_EQ(store->list({}).jobs.size(), 5u);
  }
  const std::string done = "01M7ZD1ER06667WEP120VG7WK4";
  EXPECT_EQ(store->find_key("order 2")->schedule.not_before, "2031-01-01T00:00:00.000Z");
  EXPECT_FALSE(store->find(done)->pinned);
  store->pin(done, true);
  EXPECT_FALSE(store->remove(done));
  store->pin(done, false);
  EXPECT_TRUE(store->remove(done));
  EXPECT_TRUE(store->was_removed(done));
  EXPECT_EQ(store->recover(), 1);
  EXPECT_EQ(store->claim()->id, "01M7ZD1FAYFH84SDA0NB7716S2");
}

// One of its jobs was cancelled after the clock had been set back.
TEST_F(StoreVersions, ADatabaseOfVersion3IsBroughtUpToDate) {
  load("store_version_3.sql");
  for (int opened = 0; opened < 2; ++opened) {
    reopen();
    EXPECT_EQ(store->list({}).jobs.size(), 5u);
    const std::vector<StateEvent> events = store->events({}, 0, 100);
    ASSERT_EQ(events.size(), 9u);
    std::map<std::string, std::uint64_t> last_seq;
    for (std::size_t i = 0; i < events.size(); ++i) {
      EXPECT_EQ(events[i].number, i + 1);
      EXPECT_EQ(events[i].seq, ++last_seq[events[i].job]) << "no job's events are out of order";
    }
    EXPECT_EQ(events[4].time, "2026-11-22T11:17:39.938Z") << "behind those that were there before it";
    EXPECT_EQ(store->last_event({}), 9u);
  }
  EXPECT_TRUE(store->queue_paused());
  EXPECT_TRUE(store->was_removed("01M81FKPXJ45AA00VNDSBJGSD1"));
  EXPECT_TRUE(store->find("01M81FKQZ2Y999AWG75R8YJM6H")->pinned);
  EXPECT_EQ(store->counts().at(JobState::cancelled), 1u);
  add();
  EXPECT_EQ(store->last_event({}), 10u);
}

TEST_F(StoreVersions, ADatabaseOfVersion4IsBroughtUpToDate) {
  load("store_version_4.sql");
  for (int opened = 0; opened < 2; ++opened) {
    reopen();
    EXPECT_EQ(store->epoch(), "01M82FQJD15P426HDHGW3E8Q3B");
    EXPECT_EQ(store->list({}).jobs.size(), 3u);
  }
  EXPECT_EQ(store->find_key("order 1")->inherited, "");
  NewJob job;
  job.spec = "{}";
  job.inherited = "from another";
  EXPECT_EQ(store->find(store->submit(job).job.id)->inherited, "from another");
}

TEST_F(StoreVersions, ADatabaseOfANewerVersionIsRefused) {
  store.reset();
  Database(file()).run("PRAGMA user_version=99");
  EXPECT_THROW(open_sqlite_store(file()), StorageError);
}

}  // namespace
}  // namespace sculpt::server
