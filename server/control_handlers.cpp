// What an operator says to jobs and to the queue.
#include <spdlog/spdlog.h>

#include "server/handlers.hpp"
#include "server/services.hpp"

namespace sculpt {
namespace {

using Command = JobState (JobStore::*)(const std::string&);

// Tells the store, then whoever runs the job or could run it now.
void command(Services& services, const Call& call, Command told) {
  const std::string job = read_job_id(call.params);
  const JobState state = (services.store.*told)(job);
  if (state == JobState::cancelling || state == JobState::pausing) services.scheduler.stop_run(job);
  if (state == JobState::queued) services.scheduler.wake();
  answer(call, {{"job", job}, {"state", name(state)}});
  services.changed(job);
}

void set_queue(Services& services, const Call& call, bool paused) {
  read_nothing(call.params);
  services.store.set_queue_paused(paused);
  spdlog::info("the queue is {}", paused ? "paused" : "open");
  if (!paused) services.scheduler.wake();
  answer(call, {{"paused", paused}});
}

}  // namespace

void on_cancel(Services& services, Call call) {
  command(services, call, &JobStore::cancel);
}

void on_pause(Services& services, Call call) {
  command(services, call, &JobStore::pause);
}

void on_resume(Services& services, Call call) {
  command(services, call, &JobStore::resume);
}

void on_retry(Services& services, Call call) {
  command(services, call, &JobStore::retry);
}

void on_queue_pause(Services& services, Call call) {
  set_queue(services, call, true);
}

void on_queue_resume(Services& services, Call call) {
  set_queue(services, call, false);
}

}  // namespace sculpt
