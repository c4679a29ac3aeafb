#include "server/files/data_folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <fstream>
#include <future>
#include <memory>

#include "tests/server/temp_folder.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

class DataFolderTest : public testing::Test {
 protected:
  DataFolderTest() { fs::create_directories(draft.parent_path()); }
  bool drafts_can_be_removed() const {
    const int jobs = ::open((folder.path() / "jobs").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool free = ::flock(jobs, LOCK_EX | LOCK_NB) == 0;
    ::close(jobs);
    return free;
  }

  TempFolder folder;
  const fs::path draft = folder.path() / "jobs/JOB/report.json.draft";
};

TEST_F(DataFolderTest, DraftsOfADaemonThatDiedAreRemoved) {
  std::ofstream(draft) << "half of a rep";
  const DataFolder opened(folder.path());
  EXPECT_FALSE(fs::exists(draft));
}

TEST_F(DataFolderTest, ASecondDaemonIsRefused) {
  const DataFolder first(folder.path());
  EXPECT_THROW(DataFolder(folder.path(), std::chrono::milliseconds(20)), DataFolderError);
}

// What a daemon was about to start when it was killed: 2 of 150 restarts at once were refused.
TEST_F(DataFolderTest, TheLockOfADaemonThatIsGoneIsWaitedForWhileAChildHasACopyOfIt) {
  std::array<int, 2> go{};
  ASSERT_EQ(::pipe(go.data()), 0);
  pid_t child = 0;
  {
    const DataFolder killed(folder.path());
    child = ::fork();  // with all descriptors, as before an exec
    if (child == 0) {
      char byte = 0;
      ::close(go[1]);
      static_cast<void>(::read(go[0], &byte, 1));
      ::_exit(0);
    }
  }
  EXPECT_THROW(DataFolder(folder.path(), std::chrono::milliseconds(20)), DataFolderError);
  auto next = std::async(std::launch::async,
                         [this] { return std::make_unique<DataFolder>(folder.path(), std::chrono::hours(1)); });
  EXPECT_EQ(next.wait_for(std::chrono::milliseconds(50)), std::future_status::timeout);
  ::close(go[0]);
  ::close(go[1]);
  EXPECT_NO_THROW(next.get());
  ::waitpid(child, nullptr, 0);
}

// A process of a killed daemon that is still about to make a draft: found once by torture/protocol_model.py, seed 12.
TEST_F(DataFolderTest, TheNextDaemonWaitsForWhoStillWritesIntoTheJobs) {
  std::array<int, 2> go{};
  ASSERT_EQ(::pipe(go.data()), 0);
  const pid_t orphan = ::fork();
  if (orphan == 0) {
    hold_until_exit(folder.path() / "jobs");
    char byte = 0;
    ::close(go[1]);
    static_cast<void>(::read(go[0], &byte, 1));
    std::ofstream(draft) << "late";
    ::_exit(0);
  }
  while (drafts_can_be_removed()) {
  }
  auto next = std::async(std::launch::async, [this] { return std::make_unique<DataFolder>(folder.path()); });
  EXPECT_EQ(next.wait_for(std::chrono::milliseconds(50)), std::future_status::timeout);
  ::close(go[0]);
  ::close(go[1]);
  next.get();
  EXPECT_FALSE(fs::exists(draft));
  EXPECT_TRUE(drafts_can_be_removed());
  ::waitpid(orphan, nullptr, 0);
}

}  // namespace
}  // namespace sculpt::server
