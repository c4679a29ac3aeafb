#include "server/api/job_page.hpp"

#include <gtest/gtest.h>

#include "server/queue/scheduler.hpp"
#include "tests/server/long_queue.hpp"
#include "tests/server/temp_folder.hpp"

namespace sculpt::server {
namespace {

constexpr std::size_t long_line = 1 << 20;

class JobPageTest : public testing::Test {
 protected:
  JobPageTest() {
    open_sqlite_store(file());
    fill_queue(file(), 10);
  }
  void change(const std::string& sql) { Database(file()).run(sql.c_str()); }
  Json page(const proto::ListParams& list, std::size_t max_line = long_line) {
    const std::unique_ptr<JobStore> store = open_sqlite_store(file());
    const Scheduler scheduler{*store, {}, {}};
    return job_page({*store, scheduler, {}}, list, max_line);
  }
  std::filesystem::path file() const { return folder.path() / "sculptd.db"; }
  static std::vector<int> numbers(const Json& page) {
    std::vector<int> numbers;
    for (const Json& job : page.at("jobs")) numbers.push_back(std::stoi(job.at("job").get<std::string>()));
    return numbers;
  }

  TempFolder folder;
};

TEST_F(JobPageTest, PagesFollowEachOtherInBothOrders) {
  const Json oldest = page({.limit = 3});
  EXPECT_EQ(numbers(oldest), (std::vector{1, 2, 3}));
  EXPECT_TRUE(oldest.at("more"));
  EXPECT_EQ(oldest.at("last"), 10);
  EXPECT_FALSE(oldest.contains("damaged"));
  EXPECT_EQ(numbers(page({.after = long_queue_id(3), .limit = 3})), (std::vector{4, 5, 6}));
  EXPECT_EQ(numbers(page({.newest = true, .limit = 3})), (std::vector{10, 9, 8}));
  const Json rest = page({.before = long_queue_id(3), .newest = true, .limit = 3});
  EXPECT_EQ(numbers(rest), (std::vector{2, 1}));
  EXPECT_FALSE(rest.at("more"));
}

TEST_F(JobPageTest, APositionIsThatInTheQueue) {
  const Json whole = page({});
  for (const Json& job : whole.at("jobs")) {
    const int n = std::stoi(job.at("job").get<std::string>());
    const auto before = [n](int other) { return other - 1000 * (other % 7) < n - 1000 * (n % 7) ? 1 : 0; };
    int position = 0;
    for (int other = 1; other <= 10; ++other) position += before(other);
    EXPECT_EQ(job.at("position"), position) << n;
  }
}

TEST_F(JobPageTest, DamagedRowsAreNamedAndTheOthersCome) {
  change(
      "UPDATE job SET state='exploded' WHERE number=2; UPDATE job SET spec='{' WHERE number=3;"
      "UPDATE job SET spec='{}' WHERE number=5;");
  const Json found = page({.limit = 4});
  EXPECT_EQ(numbers(found), (std::vector{1, 4, 6, 7}));
  ASSERT_EQ(found.at("damaged").size(), 3u);
  EXPECT_EQ(found.at("damaged")[0].at("job"), long_queue_id(2));
  EXPECT_FALSE(found.at("damaged")[0].at("message").get<std::string>().empty());
  EXPECT_TRUE(found.at("more"));
}

TEST_F(JobPageTest, MoreDamagedRowsThanAPageDoNotEndTheList) {
  change("UPDATE job SET spec='{' WHERE number<=6");
  const Json found = page({.limit = 2});
  EXPECT_EQ(numbers(found), (std::vector{7, 8}));
  EXPECT_TRUE(found.at("more"));
}

TEST_F(JobPageTest, APageIsCutWhereTheLineWouldBeTooLong) {
  const std::size_t bytes = proto::write_json(page({})).size();
  for (const std::size_t max_line : {bytes / 2, std::size_t{256}}) {
    const Json cut = page({}, max_line);
    EXPECT_LT(cut.at("jobs").size(), 10u);
    EXPECT_FALSE(cut.at("jobs").empty()) << "or a client would never come further";
    EXPECT_TRUE(cut.at("more"));
  }
}

}  // namespace
}  // namespace sculpt::server
