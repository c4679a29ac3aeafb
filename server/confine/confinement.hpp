// What a process that reads files from outside may still do: compute, speak to its parent and, at most, use one folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace sculpt::server {

/// Memory and address space mean little under a sanitizer, which also needs what the filter forbids.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool under_sanitizer = true;
#else
inline constexpr bool under_sanitizer = false;
#endif

struct Confinement {
  std::uint64_t memory_bytes = 0;  ///< predicted at most; the limit leaves room for a prediction that is too low
  int threads = 1;                 ///< each has a stack of its own besides
  std::int64_t cpu_s = 0;          ///< of all threads together; 0: no limit
  std::filesystem::path folder;    ///< the one folder whose files it may use; empty: none
  bool writes = false;             ///< and change
};

/// For this process, for good: limits on memory, CPU time, files and core dumps, no new privileges, no files but those
/// of the folder and the program's own (Landlock), and no system calls but those that computing needs (seccomp): no
/// sockets, no programs, no processes, no signals to others. Call while there is one thread. What the kernel does not
/// offer is left out, and named with the reason.
std::vector<std::string> confine(const Confinement& wanted);

/// What of it this kernel, or a sandbox around this process, refuses. Changes nothing.
std::vector<std::string> missing_confinement();

}  // namespace sculpt::server
