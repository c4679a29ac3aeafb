// What an operator says to jobs and to the queue.
#include <spdlog/spdlog.h>

#include "server/detour.hpp"
#include "server/handlers.hpp"

namespace sculpt {
namespace {

using Command = JobState (JobStore::*)(const std::string&);

// Tells the store, then whoever runs the job or could run it now.
void command(Services& services, Call call, Command told) {
  const std::string job = read_job_id(call.params);
  call.session->hold();
  detour(
      services.changes, services, std::move(call),
      [&services, job, told](const std::stop_token&) {
        const JobState state = (services.store.*told)(job);
        if (state == JobState::cancelling || state == JobState::pausing) services.scheduler.stop_run(job);
        if (state == JobState::queued) services.scheduler.wake();
        return state;
      },
      [&services, job](const Call& done, JobState state) {
        answer(done, {{"job", job}, {"state", name(state)}});
        services.changed(job);
      });
}

void set_queue(Services& services, Call call, bool paused) {
  read_nothing(call.params);
  call.session->hold();
  answer_from(services.changes, services, std::move(call), [&services, paused](const std::stop_token&) {
    services.store.set_queue_paused(paused);
    spdlog::info("the queue is {}", paused ? "paused" : "open");
    if (!paused) services.scheduler.wake();
    return Answer{{{"paused", paused}}, std::nullopt};
  });
}

}  // namespace

void on_cancel(Services& services, Call call) {
  command(services, std::move(call), &JobStore::cancel);
}

void on_pause(Services& services, Call call) {
  command(services, std::move(call), &JobStore::pause);
}

void on_resume(Services& services, Call call) {
  command(services, std::move(call), &JobStore::resume);
}

void on_retry(Services& services, Call call) {
  command(services, std::move(call), &JobStore::retry);
}

void on_queue_pause(Services& services, Call call) {
  set_queue(services, std::move(call), true);
}

void on_queue_resume(Services& services, Call call) {
  set_queue(services, std::move(call), false);
}

}  // namespace sculpt
