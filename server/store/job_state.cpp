#include "server/store/job_state.hpp"

#include <algorithm>

namespace sculpt::server {
namespace {

using enum JobState;

struct Move {
  JobState from, to;
  bool operator==(const Move&) const = default;
};

constexpr std::array moves{
    // time and workers
    Move{held, queued}, Move{backoff, queued}, Move{held, expired}, Move{queued, expired}, Move{queued, running},
    // how a run ends; back to the queue: interrupted, because the daemon stopped or was killed
    Move{running, queued}, Move{running, succeeded}, Move{running, failed}, Move{running, backoff},
    Move{running, quarantined},
    // pause
    Move{held, paused}, Move{queued, paused}, Move{backoff, paused}, Move{running, pausing}, Move{pausing, paused},
    Move{pausing, succeeded}, Move{pausing, failed}, Move{pausing, quarantined}, Move{paused, held},
    Move{paused, queued},
    // cancel
    Move{held, cancelled}, Move{queued, cancelled}, Move{backoff, cancelled}, Move{paused, cancelled},
    Move{running, cancelling}, Move{pausing, cancelling}, Move{cancelling, cancelled},
    // an operator: what crashed, and what ended with artifacts that were damaged since
    Move{quarantined, queued}, Move{succeeded, queued}, Move{failed, queued}};

struct Named {
  JobState state;
  const char* name;
};

constexpr std::array names{Named{held, "held"},
                           Named{queued, "queued"},
                           Named{running, "running"},
                           Named{pausing, "pausing"},
                           Named{paused, "paused"},
                           Named{backoff, "backoff"},
                           Named{cancelling, "cancelling"},
                           Named{succeeded, "succeeded"},
                           Named{failed, "failed"},
                           Named{quarantined, "quarantined"},
                           Named{expired, "expired"},
                           Named{cancelled, "cancelled"}};
static_assert(names.size() == job_states.size());

}  // namespace

const char* name(JobState state) {
  return std::ranges::find(names, state, &Named::state)->name;
}

std::optional<JobState> find_state(std::string_view word) {
  const auto* found = std::ranges::find(names, word, &Named::name);
  return found == names.end() ? std::nullopt : std::optional(found->state);
}

bool is_final(JobState state) {
  return state == succeeded || state == failed || state == quarantined || state == expired || state == cancelled;
}

bool is_active(JobState state) {
  return state == running || state == pausing || state == cancelling;
}

bool may_move(JobState from, JobState to) {
  return std::ranges::find(moves, Move{from, to}) != moves.end();
}

}  // namespace sculpt::server
