// What questions to a long queue cost, in steps of SQLite's machine: time would tell of the machine that the test is
// on.
#include "server/store/sqlite/store_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/server/long_queue.hpp"
#include "tests/server/temp_folder.hpp"

namespace sculpt::server {
namespace {

constexpr int short_queue = 10'000, long_queue = 100'000;
constexpr int steps_at_once = 50;  // SQLite counts about so exactly

class LongQueue {
 public:
  explicit LongQueue(int jobs) : jobs_(jobs) {
    open_sqlite_store(file());
    fill_queue(file(), jobs);
    database_.emplace(file(), Database::Use::read);
    reader_.emplace(*database_);
  }

  std::filesystem::path file() const { return folder_.path() / "sculptd.db"; }
  std::string middle() const { return long_queue_id(jobs_ / 2); }

  std::uint64_t steps_of(const std::function<void(StoreReader&)>& ask) {
    std::uint64_t calls = 0;
    const auto count = [](void* sum) { return ++*static_cast<std::uint64_t*>(sum), 0; };
    sqlite3_progress_handler(database_->get(), steps_at_once, count, &calls);
    ask(*reader_);
    sqlite3_progress_handler(database_->get(), 0, nullptr, nullptr);
    return calls * steps_at_once;
  }

 private:
  TempFolder folder_;
  int jobs_;
  std::optional<Database> database_;
  std::optional<StoreReader> reader_;
};

TEST(StoreReader, NoQuestionCostsMoreInALongerQueue) {
  LongQueue few(short_queue), many(long_queue);
  const auto compare = [&](const char* what, const std::function<void(const LongQueue&, StoreReader&)>& ask) {
    const auto in_few = few.steps_of([&](StoreReader& reader) { ask(few, reader); });
    const auto in_many = many.steps_of([&](StoreReader& reader) { ask(many, reader); });
    EXPECT_LE(in_many, 2 * in_few + 10 * steps_at_once) << what;
  };
  compare("a page",
          [](const LongQueue&, StoreReader& reader) { EXPECT_EQ(reader.list({.limit = 1000}).jobs.size(), 1000u); });
  compare("a page from the middle", [](const LongQueue& queue, StoreReader& reader) {
    EXPECT_EQ(reader.list({.after = queue.middle(), .limit = 1000}).jobs.size(), 1000u);
  });
  compare("the newest before the middle", [](const LongQueue& queue, StoreReader& reader) {
    EXPECT_EQ(reader.list({.before = queue.middle(), .newest = true, .limit = 1000}).jobs.size(), 1000u);
  });
  compare("a job", [](const LongQueue& queue, StoreReader& reader) { EXPECT_TRUE(reader.find(queue.middle())); });
  compare("its events", [](const LongQueue& queue, StoreReader& reader) {
    EXPECT_EQ(reader.events(queue.middle(), 0, 64).size(), 1u);
    EXPECT_EQ(reader.last_event(queue.middle()), 1u);
  });
  compare("events of all jobs", [](const LongQueue&, StoreReader& reader) {
    EXPECT_EQ(reader.events({}, 5000, 64).size(), 64u);
    EXPECT_GE(reader.last_event({}), 10'000u);
  });
}

TEST(StoreReader, APageOfAThousandJobsIsAFewStepsAJob) {
  LongQueue queue(long_queue);
  EXPECT_LT(queue.steps_of([](StoreReader& reader) { reader.list({.limit = 1000}); }), 100'000u);
}

// As job.list asks for them: the queue is never counted through for one.
TEST(StoreReader, PositionsInALongQueueAreThoseOfTheOrder) {
  LongQueue queue(long_queue);
  std::vector<std::pair<std::int64_t, std::string>> order;
  for (int n = 1; n <= long_queue; ++n) order.emplace_back(n - 1000 * (n % 7), long_queue_id(n));
  std::ranges::sort(order);
  const std::unique_ptr<JobStore> store = open_sqlite_store(queue.file());
  EXPECT_EQ(store->claim()->id, order.front().second);
  order.erase(order.begin());
  for (const JobRecord& job : store->list({.after = queue.middle(), .limit = 1000}).jobs) {
    const auto place = std::ranges::lower_bound(order, std::pair(job.rank, job.id));
    ASSERT_EQ(store->position(job), static_cast<std::uint64_t>(place - order.begin())) << job.id;
  }
}

}  // namespace
}  // namespace sculpt::server
