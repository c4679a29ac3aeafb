#include "server/confine/syscall_filter.hpp"

#include <sched.h>
#include <seccomp.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <initializer_list>
#include <memory>

namespace sculpt::server {
namespace {

// Names that an architecture does not have are skipped: some are of x86 only, some of newer kernels.
constexpr std::initializer_list<const char*> allowed{
    // memory
    "brk", "mmap", "munmap", "mremap", "mprotect", "madvise", "membarrier",
    // threads, whose making is looked at below
    "exit", "exit_group", "futex", "gettid", "getpid", "getppid", "rseq", "set_robust_list", "set_tid_address",
    "arch_prctl", "sched_yield", "sched_getaffinity", "getcpu", "restart_syscall",
    // signals of its own
    "rt_sigaction", "rt_sigprocmask", "rt_sigreturn", "rt_sigtimedwait", "sigaltstack",
    // time and figures
    "clock_gettime", "clock_getres", "clock_nanosleep", "nanosleep", "gettimeofday", "getrusage", "sysinfo", "uname",
    "getrandom", "getuid", "geteuid", "getgid", "getegid", "getrlimit", "getpriority",
    // open files; which can be opened is Landlock's matter
    "read", "write", "readv", "writev", "pread64", "pwrite64", "lseek", "close", "fcntl", "dup", "dup2", "dup3", "poll",
    "ppoll", "fsync", "fdatasync", "sync_file_range", "fadvise64", "ftruncate", "fallocate", "fstat", "newfstatat",
    "stat", "lstat", "statx", "fstatfs", "statfs", "open", "openat", "access", "faccessat", "faccessat2", "readlink",
    "readlinkat", "getcwd", "getdents64", "mkdir", "mkdirat", "rename", "renameat", "renameat2", "unlink", "unlinkat",
    "truncate"};

using Filter = std::unique_ptr<void, decltype(&seccomp_release)>;

// Gives 0, or the errno.
int allow(const Filter& filter, const char* name) {
  const int number = seccomp_syscall_resolve_name(name);
  return number == __NR_SCMP_ERROR ? 0 : -seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, number, 0);
}

int allow(const Filter& filter, const char* name, std::initializer_list<scmp_arg_cmp> when) {
  return -seccomp_rule_add_array(filter.get(), SCMP_ACT_ALLOW, seccomp_syscall_resolve_name(name),
                                 static_cast<unsigned>(when.size()), when.begin());
}

// Of what can be done to any process only what is done to this one, or to the calling thread (0).
int allow_for_itself(const Filter& filter) {
  const auto self = static_cast<scmp_datum_t>(::getpid());
  if (const int error = allow(filter, "tgkill", {SCMP_A0(SCMP_CMP_EQ, self)})) return error;
  if (const int error = allow(filter, "prlimit64", {SCMP_A0(SCMP_CMP_EQ, 0)})) return error;
  if (const int error = allow(filter, "sched_setaffinity", {SCMP_A0(SCMP_CMP_EQ, 0)})) return error;
  const auto priority = {SCMP_A0(SCMP_CMP_EQ, PRIO_PROCESS), SCMP_A1(SCMP_CMP_EQ, 0)};
  if (const int error = allow(filter, "setpriority", priority)) return error;
  // Not so clone3, whose flags a filter cannot see: the C library then makes its threads by clone.
  return allow(filter, "clone", {SCMP_A0(SCMP_CMP_MASKED_EQ, CLONE_THREAD, CLONE_THREAD)});
}

}  // namespace

int filter_syscalls() {
  const Filter filter(seccomp_init(SCMP_ACT_ERRNO(ENOSYS)), &seccomp_release);
  if (filter == nullptr) return ENOMEM;
  for (const char* name : allowed)
    if (const int error = allow(filter, name)) return error;
  if (const int error = allow_for_itself(filter)) return error;
  return -seccomp_load(filter.get());
}

}  // namespace sculpt::server
