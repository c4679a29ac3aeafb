#include "server/confine/confinement.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <thread>

#include "tests/server/temp_folder.hpp"

namespace sculpt::server {
namespace {

// The exit code of a process that is confined so and then does this.
int confined(const Confinement& wanted, const std::function<bool()>& act) {
  const pid_t process = ::fork();
  if (process == 0) {
    confine(wanted);
    ::_exit(act() ? 1 : 0);
  }
  int status = 0;
  ::waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool can_read(const std::filesystem::path& file) {
  return ::open(file.c_str(), O_RDONLY) >= 0;
}

bool can_write(const std::filesystem::path& file) {
  return ::open(file.c_str(), O_WRONLY | O_CREAT, 0600) >= 0;
}

class ConfinementTest : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(own);
    std::ofstream(tokens) << "secret";
    std::ofstream(own / "trajectory") << "lines";
  }
  bool offered(const std::string& what) const {
    const std::vector<std::string> missing = missing_confinement();
    return std::ranges::none_of(missing, [&](const std::string& part) { return part.starts_with(what); });
  }

  TempFolder folder;
  const std::filesystem::path own = folder.path() / "jobs" / "JOB", tokens = folder.path() / "tokens.json";
  Confinement wanted{64u << 20, 2, 0, own, true};
};

TEST_F(ConfinementTest, NoFileCanBeUsedButThoseOfItsFolder) {
  if (!offered("Landlock")) GTEST_SKIP() << "this kernel has no Landlock, or a sandbox around the test refuses it";
  EXPECT_EQ(confined(wanted, [&] { return can_read(tokens); }), 0);
  EXPECT_EQ(confined(wanted, [&] { return can_write(folder.path() / "new"); }), 0);
  EXPECT_EQ(confined(wanted, [&] { return can_read("/etc/passwd"); }), 0);
  EXPECT_EQ(
      confined(wanted, [&] { return ::rename((own / "trajectory").c_str(), (folder.path() / "out").c_str()) == 0; }),
      0);
  EXPECT_EQ(confined(wanted, [&] { return can_read(own / "trajectory") && can_write(own / "new"); }), 1);
  wanted.writes = false;
  EXPECT_EQ(confined(wanted, [&] { return can_read(own / "trajectory"); }), 1);
  EXPECT_EQ(confined(wanted, [&] { return can_write(own / "newer"); }), 0);
  wanted.folder.clear();
  EXPECT_EQ(confined(wanted, [&] { return can_read(own / "trajectory"); }), 0);
  EXPECT_TRUE(can_read(tokens)) << "this process is not confined";
}

TEST_F(ConfinementTest, NoSocketsProgramsProcessesAndSignalsToOthers) {
  if (under_sanitizer || !offered("seccomp")) GTEST_SKIP() << "no seccomp here";
  EXPECT_EQ(confined(wanted, [] { return ::socket(AF_INET, SOCK_STREAM, 0) >= 0; }), 0);
  EXPECT_EQ(confined(wanted, [] { return ::socket(AF_UNIX, SOCK_STREAM, 0) >= 0; }), 0);
  EXPECT_EQ(confined(wanted, [] { return ::fork() >= 0; }), 0);
  EXPECT_EQ(confined(wanted, [] { return ::vfork() >= 0; }), 0);
  EXPECT_EQ(confined(wanted, [] { return ::kill(::getppid(), 0) == 0; }), 0);
  EXPECT_EQ(confined(wanted,
                     [] {
                       const rlimit none{};
                       return ::prlimit(::getppid(), RLIMIT_CORE, nullptr, nullptr) == 0 ||
                              ::prlimit(::getppid(), RLIMIT_CORE, &none, nullptr) == 0;
                     }),
            0);
  EXPECT_EQ(confined(wanted,
                     [] {
                       return ::setpriority(PRIO_PROCESS, static_cast<id_t>(::getppid()), 19) == 0 ||
                              ::setpriority(PRIO_PGRP, 0, 19) == 0 || ::setpriority(PRIO_USER, 0, 19) == 0;
                     }),
            0);
  EXPECT_EQ(confined(wanted, [] { return ::setpriority(PRIO_PROCESS, 0, 19) == 0; }), 1) << "its own it may lower";
  const int ran = confined(wanted, [] { return ::execl("/bin/sh", "sh", "-c", "exit 7", nullptr) == 0; });
  EXPECT_EQ(ran, 0) << "7 if the program ran";
}

TEST_F(ConfinementTest, MemoryIsLimitedAndTheRestStillWorks) {
  const auto take = [](std::size_t bytes) {
    return ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0) !=
           MAP_FAILED;
  };
  if (!under_sanitizer) {
    EXPECT_EQ(confined(wanted, [&] { return take(8ull << 30); }), 0);
  }
  EXPECT_EQ(confined(wanted, [&] { return take(64u << 20); }), 1);
  EXPECT_EQ(confined(wanted,
                     [] {
                       int sum = 0;
                       std::thread([&sum] { sum = 5; }).join();
                       return sum == 5 && std::thread::hardware_concurrency() > 0;
                     }),
            1);
  EXPECT_EQ(confined(wanted, []() -> bool { std::abort(); }), 128 + SIGABRT);
}

TEST_F(ConfinementTest, TimeFilesAndCoresAreLimited) {
  wanted.cpu_s = 3;
  const auto most = [&](auto resource) {
    return confined(wanted, [&] {
      rlimit now{};
      ::getrlimit(resource, &now);
      ::_exit(now.rlim_cur > 100 ? 101 : static_cast<int>(now.rlim_cur));
      return false;
    });
  };
  EXPECT_EQ(most(RLIMIT_CPU), 3);
  EXPECT_EQ(most(RLIMIT_CORE), 0);
  EXPECT_EQ(most(RLIMIT_NOFILE), 64);
  wanted.writes = false;
  EXPECT_EQ(most(RLIMIT_FSIZE), 0);
}

}  // namespace
}  // namespace sculpt::server
