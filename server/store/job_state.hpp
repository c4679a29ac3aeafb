// The states of a job and the one table of the moves between them (proto/PROTOCOL.md section 3 has the picture).
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace sculpt::server {

enum class JobState {
  held,         ///< not before its time
  queued,       ///< waits for a worker
  running,      //
  pausing,      ///< runs and is asked to stop
  paused,       ///< waits for job.resume
  backoff,      ///< failed for a reason that may pass, and is tried again
  cancelling,   ///< runs and is asked to stop for good
  succeeded,    //
  failed,       //
  quarantined,  ///< took a process down twice; only job.retry lets it run again
  expired,      ///< did not start in time
  cancelled
};

inline constexpr std::array job_states{JobState::held,        JobState::queued,    JobState::running,
                                       JobState::pausing,     JobState::paused,    JobState::backoff,
                                       JobState::cancelling,  JobState::succeeded, JobState::failed,
                                       JobState::quarantined, JobState::expired,   JobState::cancelled};

const char* name(JobState state);
std::optional<JobState> find_state(std::string_view word);
/// It has ended: nothing happens to it any more, unless an operator retries a quarantined one.
bool is_final(JobState state);
/// A worker has it.
bool is_active(JobState state);
bool may_move(JobState from, JobState to);

}  // namespace sculpt::server
