// A program of our own as a child, with one socket as its standard input and output. It never outlives its parent.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace sculpt::server {

/// Belongs to one thread, which must live as long as the child. The destructor kills and reaps.
class ChildProcess {
 public:
  /// The child inherits standard error, no other file and no environment (but for a sanitizer's options). Throws
  /// std::system_error.
  ChildProcess(const std::filesystem::path& program, const std::string& argument);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// All that the child will read, then the end of its input. A child that is gone takes nothing; its end says why.
  void send(std::string_view bytes);
  /// What the child printed: nothing if it was silent for so long, "" when it has closed its output.
  std::optional<std::string> read(std::chrono::milliseconds patience);
  void signal(int number);
  /// Waits for the end. "" if the child ended by itself with exit code 0, else how it ended: "exit code 3", "signal 11
  /// (Segmentation fault)".
  std::string wait();

 private:
  pid_t process_ = -1;
  int socket_ = -1;
};

/// For the child: the way to its parent. Standard output itself becomes standard error, so that a library that prints
/// spoils no line.
std::FILE* take_output();

/// For the child, before it changes anything: from now on the kernel kills this process when the thread that made it
/// ends, and prefers it when memory runs out. Ends the process if `parent` is not its parent any more.
void tie_to_parent(pid_t parent);

}  // namespace sculpt::server
