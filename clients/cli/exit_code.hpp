// How a run of `sculpt` ends: the exit codes are a promise to scripts.
#pragma once

#include <stdexcept>
#include <string>

namespace sculpt::cli {

enum ExitCode : int {
  exit_fine = 0,
  exit_failed = 1,       ///< the job failed or was cancelled, or the check found something
  exit_usage = 2,        ///< the command line, or a file named on it, cannot be used
  exit_unreachable = 3,  ///< no server answers
  exit_refused = 4,      ///< the input was understood and refused, here or by the server
};

/// Ends the command: main prints `sculpt: CODE: sentence` on stderr and exits with `exit_code`.
class Failure : public std::runtime_error {
 public:
  Failure(ExitCode exit_code, std::string code, const std::string& sentence)
      : std::runtime_error(sentence), exit_code_(exit_code), code_(std::move(code)) {}
  ExitCode exit_code() const { return exit_code_; }
  const std::string& code() const { return code_; }

 private:
  ExitCode exit_code_;
  std::string code_;
};

}  // namespace sculpt::cli
