// What an operator says to jobs and to the queue.
#include <spdlog/spdlog.h>

#include "server/api/handlers.hpp"

namespace sculpt::server {
namespace {

using Command = JobState (JobStore::*)(const std::string&);

// Tells the store, then whoever runs the job or could run it now.
void command(const ControlGroup& group, Call call, Command told) {
  const std::string job = proto::read_job_id(call.params);
  call.session->hold();
  group.answers.detour(
      group.changes, std::move(call),
      [group, job, told](const std::stop_token&) {
        const JobState state = (group.store.*told)(job);
        if (state == JobState::cancelling || state == JobState::pausing) group.scheduler.stop_run(job);
        if (state == JobState::queued) group.scheduler.wake();
        return state;
      },
      [group, job](const Call& done, JobState state) {
        answer(done, {{"job", job}, {"state", name(state)}});
        group.changed(job);
      });
}

void set_queue(const ControlGroup& group, Call call, bool paused) {
  proto::read_nothing(call.params);
  call.session->hold();
  group.answers.from(group.changes, std::move(call), [group, paused](const std::stop_token&) {
    group.store.set_queue_paused(paused);
    spdlog::info("the queue is {}", paused ? "paused" : "open");
    if (!paused) group.scheduler.wake();
    return Answer{{{"paused", paused}}, std::nullopt};
  });
}

}  // namespace

Handlers control_handlers(const ControlGroup& group) {
  const auto commanded = [group](Command told) {
    return [group, told](Call call) { command(group, std::move(call), told); };
  };
  const auto queue_set = [group](bool paused) {
    return [group, paused](Call call) { set_queue(group, std::move(call), paused); };
  };
  return {
      {"job.cancel", commanded(&JobStore::cancel)},
      {"job.pause", commanded(&JobStore::pause)},
      {"job.resume", commanded(&JobStore::resume)},
      {"job.retry", commanded(&JobStore::retry)},
      {"queue.pause", queue_set(true)},
      {"queue.resume", queue_set(false)},
  };
}

}  // namespace sculpt::server
