#include "server/confine/confinement.hpp"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <system_error>
#include <thread>

#include "server/confine/file_fence.hpp"
#include "server/confine/syscall_filter.hpp"

#ifdef __SANITIZE_ADDRESS__
namespace {
bool is_confined = false;
}
// Asked at the end of a process: the search for leaks wants to trace it, and would wait for ever where that is refused.
extern "C" int __lsan_is_turned_off();
extern "C" int __lsan_is_turned_off() {
  return is_confined ? 1 : 0;
}
#endif

namespace sculpt::server {
namespace {

// A prediction is no bound: what is over it by less than a half is only wrong, more is a fault.
constexpr std::uint64_t slack_bytes = 256u << 20, stack_bytes = 9u << 20, heap_reserve_bytes = 128u << 20;
constexpr std::uint64_t max_file_bytes = 64ull << 30;
constexpr rlim_t max_files = 64;

struct Size {
  std::uint64_t all = 0, written = 0;  // bytes of address space, and of that private memory that can be written
};

Size size_now() {
  std::uint64_t all = 0, resident = 0, shared = 0, code = 0, libraries = 0, data = 0;
  std::ifstream("/proc/self/statm") >> all >> resident >> shared >> code >> libraries >> data;
  const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return {all * page, data * page};
}

void limit(decltype(RLIMIT_AS) resource, rlim_t most) {
  rlimit now{};
  ::getrlimit(resource, &now);
  const rlimit lower{std::min(now.rlim_cur, most), std::min(now.rlim_max, most)};
  ::setrlimit(resource, &lower);
}

void set_limits(const Confinement& wanted) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_NOFILE, max_files);
  std::signal(SIGXFSZ, SIG_IGN);  // a write that is too long is an error like a full disk
  limit(RLIMIT_FSIZE, wanted.writes ? max_file_bytes : 0);
  if (wanted.cpu_s > 0) limit(RLIMIT_CPU, static_cast<rlim_t>(wanted.cpu_s));
  if (under_sanitizer) return;
  const Size now = size_now();
  const auto threads = static_cast<std::uint64_t>(wanted.threads);
  const std::uint64_t more = wanted.memory_bytes + wanted.memory_bytes / 2 + slack_bytes + threads * stack_bytes;
  limit(RLIMIT_DATA, now.written + more);
  limit(RLIMIT_AS, now.all + more + threads * heap_reserve_bytes);  // a thread's heap is reserved before it is written
}

// Of the calling thread and those that it starts.
std::vector<std::string> fence_thread(const std::filesystem::path& folder, bool writes) {
  std::vector<std::string> missing;
  const auto take = [&](const char* what, int error) {
    if (error != 0) missing.push_back(std::string(what) + " (" + std::generic_category().message(error) + ")");
  };
  take("no new privileges", ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 ? 0 : errno);
  take("Landlock", fence_files(folder, writes));
  if (!under_sanitizer) take("seccomp", filter_syscalls());
  return missing;
}

}  // namespace

std::vector<std::string> confine(const Confinement& wanted) {
#ifdef __SANITIZE_ADDRESS__
  is_confined = true;
#endif
  set_limits(wanted);
  return fence_thread(wanted.folder, wanted.writes);
}

std::vector<std::string> missing_confinement() {
  std::vector<std::string> missing;
  std::thread([&missing] { missing = fence_thread({}, false); }).join();
  return missing;
}

}  // namespace sculpt::server
