#include "server/job_state.hpp"

#include <algorithm>

namespace sculpt {
namespace {

struct Move {
  JobState from, to;
  bool operator==(const Move&) const = default;
};

constexpr std::array moves{
    Move{JobState::queued, JobState::running},        // claimed by a worker
    Move{JobState::queued, JobState::cancelled},      //
    Move{JobState::running, JobState::queued},        // interrupted: the daemon stopped or was killed
    Move{JobState::running, JobState::cancelling},    //
    Move{JobState::running, JobState::succeeded},     //
    Move{JobState::running, JobState::failed},        //
    Move{JobState::cancelling, JobState::cancelled},  // whatever the worker had reached by then
};

}  // namespace

const char* name(JobState state) {
  switch (state) {
    case JobState::queued:
      return "queued";
    case JobState::running:
      return "running";
    case JobState::cancelling:
      return "cancelling";
    case JobState::succeeded:
      return "succeeded";
    case JobState::failed:
      return "failed";
    case JobState::cancelled:
      return "cancelled";
  }
  return "unknown";
}

std::optional<JobState> find_state(std::string_view word) {
  const auto* found = std::ranges::find_if(job_states, [&](JobState state) { return word == name(state); });
  return found == job_states.end() ? std::nullopt : std::optional(*found);
}

bool is_final(JobState state) {
  return std::ranges::none_of(moves, [&](const Move& move) { return move.from == state; });
}

bool may_move(JobState from, JobState to) {
  return std::ranges::find(moves, Move{from, to}) != moves.end();
}

}  // namespace sculpt
