// What a run of a job is, and how it may end.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>

#include "core/base/watch.hpp"
#include "server/store/job_record.hpp"

namespace sculpt::server {

/// The process of a run ended before the run did.
class CrashError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Runs on a worker. May throw anything: InputError, bad_alloc, CrashError and others become a failure, Cancelled lets
/// the job go.
using RunJob = std::function<Ending(const JobRecord&, const Watch&)>;

/// What a run that threw ended with; nothing when it was let go. Ends the process after a SyncError. Call inside a
/// catch block.
std::optional<Ending> caught_ending();

}  // namespace sculpt::server
