// The states of a job and the one table of the moves between them (proto/PROTOCOL.md section 3 has the picture).
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace sculpt {

enum class JobState { queued, running, cancelling, succeeded, failed, cancelled };

inline constexpr std::array job_states{JobState::queued,    JobState::running, JobState::cancelling,
                                       JobState::succeeded, JobState::failed,  JobState::cancelled};

const char* name(JobState state);
std::optional<JobState> find_state(std::string_view word);
/// No move leads out of a final state.
bool is_final(JobState state);
bool may_move(JobState from, JobState to);

}  // namespace sculpt
