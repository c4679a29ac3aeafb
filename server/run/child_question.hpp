// A question to a process of its own: it is told of a job, works on it, and prints one JSON object.
#pragma once

#include <optional>
#include <stop_token>
#include <string>

#include "server/run/job_description.hpp"

namespace sculpt::server {

struct ChildAnswer {
  std::optional<Json> said;  ///< nothing if the process said nothing, or nonsense, or not all
  std::string end;           ///< as ChildProcess::wait; "" after an end in order
  bool too_late = false;     ///< it was killed when its time was over
};

/// Starts the worker with `option` and waits for its answer, at most for `patience` where there is one. Throws
/// Cancelled on a stop; std::system_error when there can be no process. Call on a thread that lives as long as the
/// process.
ChildAnswer ask_child(const StoredSpec& stored, const Isolation& isolation, const char* option,
                      std::optional<std::chrono::milliseconds> patience, const std::stop_token& stop);

/// What is asked about a finished job, and what the process does for that: "timed the job".
struct ResultQuestion {
  const char* option;
  const char* deed;
};
/// The same for Isolation::result_time at most, of a process that has nothing to say when it has done its work. Throws
/// InputError as reported and `run_time_exceeded`, std::runtime_error when it dies.
void ask_about_result(StoredSpec stored, const Isolation& isolation, const ResultQuestion& question,
                      const std::stop_token& stop);

/// The child's side: lets `find`, which confines this process, work on the job, and prints what it returns, or what it
/// throws as {"code","sentence"}. Gives the exit code.
int answer_parent(const std::function<Json(const DescribedJob&)>& find);
/// The same, with the job's files read.
int answer_parent(FolderUse use, const std::function<Json(const DescribedJob&, const Job&)>& find);

/// Throws the InputError that the child reported, if it did.
void rethrow_reported(const Json& said);

}  // namespace sculpt::server
