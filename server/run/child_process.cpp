#include "server/run/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "server/confine/confinement.hpp"

namespace sculpt::server {
namespace {

constexpr int oom_score = 500;

[[noreturn]] void fail(int error, const std::string& doing) {
  throw std::system_error(error, std::generic_category(), "cannot " + doing);
}

// The signals that a daemon blocks or ignores must not be so in the child.
struct SpawnAttributes {
  SpawnAttributes() {
    ::posix_spawnattr_init(&attributes);
    sigset_t none, usual;
    ::sigemptyset(&none);
    ::sigemptyset(&usual);
    ::sigaddset(&usual, SIGPIPE);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setsigdefault(&attributes, &usual);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~SpawnAttributes() { ::posix_spawnattr_destroy(&attributes); }
  posix_spawnattr_t attributes;
};

struct SpawnFiles {
  explicit SpawnFiles(int socket) {
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, socket, STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, socket, STDOUT_FILENO);
    ::posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
  }
  ~SpawnFiles() { ::posix_spawn_file_actions_destroy(&actions); }
  posix_spawn_file_actions_t actions;
};

/// A sanitizer's options, and nothing else.
std::vector<char*> environment_of_child() {
  std::vector<char*> variables;
  for (char** variable = environ; under_sanitizer && *variable != nullptr; ++variable)
    if (const std::string_view text(*variable); text.substr(0, text.find('=')).ends_with("SAN_OPTIONS"))
      variables.push_back(*variable);
  variables.push_back(nullptr);
  return variables;
}

}  // namespace

ChildProcess::ChildProcess(const std::filesystem::path& program, const std::string& argument) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) fail(errno, "make a socket for a child");
  socket_ = ends[0];
  const SpawnAttributes attributes;
  const SpawnFiles files(ends[1]);
  std::string name = program, option = argument;
  std::array<char*, 3> arguments{name.data(), option.data(), nullptr};
  const std::vector<char*> environment = environment_of_child();
  const int error = ::posix_spawn(&process_, name.c_str(), &files.actions, &attributes.attributes, arguments.data(),
                                  environment.data());
  ::close(ends[1]);
  if (error != 0) {
    ::close(socket_);
    fail(error, "start '" + name + "'");
  }
}

ChildProcess::~ChildProcess() {
  if (process_ > 0) {
    signal(SIGKILL);
    wait();
  }
  ::close(socket_);
}

void ChildProcess::send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  ::shutdown(socket_, SHUT_WR);
}

std::optional<std::string> ChildProcess::read(std::chrono::milliseconds patience) {
  pollfd waiting{socket_, POLLIN, 0};
  if (::poll(&waiting, 1, static_cast<int>(patience.count())) <= 0) return std::nullopt;
  std::string bytes(4096, '\0');
  const ssize_t got = ::recv(socket_, bytes.data(), bytes.size(), 0);
  if (got < 0 && errno == EINTR) return std::nullopt;
  bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return bytes;
}

void ChildProcess::signal(int number) {
  if (process_ > 0) ::kill(process_, number);
}

std::string ChildProcess::wait() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    return "signal " + std::to_string(number) + " (" + ::strsignal(number) + ")";
  }
  return WEXITSTATUS(status) == 0 ? "" : "exit code " + std::to_string(WEXITSTATUS(status));
}

std::FILE* take_output() {
  std::FILE* out = ::fdopen(::dup(STDOUT_FILENO), "w");
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  return out;
}

void tie_to_parent(pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(EXIT_FAILURE);
  std::ofstream("/proc/self/oom_score_adj") << oom_score;
}

}  // namespace sculpt::server
