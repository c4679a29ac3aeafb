// How a job comes into the queue.
#include <spdlog/spdlog.h>

#include "server/api/handlers.hpp"
#include "server/base/crash_point.hpp"
#include "server/results/continuation.hpp"
#include "server/run/inheritance.hpp"
#include "server/run/isolated_check.hpp"

namespace sculpt::server {
namespace {

/// A submit on its way: what the client wants, and the job that comes of it.
struct Admission {
  proto::SubmitParams submit;
  std::string client;  ///< whose checks stand in one line
  std::chrono::milliseconds check_time;
  NewJob job;
  std::string check_key;
};

Answer store_job(const SubmitGroup& group, const Admission& admission) {
  const Submitted submitted = group.store.submit(admission.job);
  crash_point(CrashPoint::submit_stored);
  spdlog::info("job={} {} mesh={} resolution={}", submitted.job.id, name(submitted.job.state),
               admission.submit.spec.mesh.name, admission.submit.spec.resolution);
  group.scheduler.wake();
  if (!submitted.duplicate) group.changed(submitted.job.id);
  return {{{"job", submitted.job.id}, {"state", name(submitted.job.state)}, {"duplicate", submitted.duplicate}},
          std::nullopt};
}

// All that can be said of the job by its spec and the sizes of its files. True if it is known to pass its check, or is
// known itself: a repeated submit is answered from the store, also when its cell is gone since.
bool prepare(const SubmitGroup& group, Admission& admission) {
  NewJob& job = admission.job;
  if (!job.key.empty() && group.store.find_key(job.key)) return true;
  proto::JobSpec& spec = admission.submit.spec;
  if (spec.continued) {
    job.inherited = inherit(*spec.continued, group.store, group.artifacts, group.blobs);
    read_inherited(job.inherited, spec);
  }
  if (job.cell_bundle.empty()) job.cell_bundle = store_cell(group.planner.read_cell(spec.robot), group.blobs);
  const JobSizes sizes = measure(spec, job.cell_bundle, group.blobs);
  check_sizes(sizes, group.defaults.memory_cap_bytes);
  job.memory_bytes = group.planner.predict_memory(sizes);
  admission.check_key = check_key(spec, job.cell_bundle, group.defaults);
  return group.passed.has(admission.check_key);
}

void check(const SubmitGroup& group, const Admission& admission, const std::stop_token& stop) {
  if (group.passed.has(admission.check_key)) return;  // since it began to wait
  const NewJob& job = admission.job;
  check_in_child({job.spec, job.cell_bundle, {}, 0, job.inherited}, group.isolation, admission.check_time, stop);
  group.passed.add(admission.check_key);
}

// On the thread of admission. Whoever needs a check waits for that at the desk, out of the way of the others.
void admit(const SubmitGroup& group, std::shared_ptr<Call> call, const std::shared_ptr<Admission>& admission) {
  bool known = false;
  try {
    known = prepare(group, *admission);
  } catch (...) {
    return group.answers.with(std::move(call), []() -> Answer { throw; });
  }
  if (known) return group.answers.with(std::move(call), [&] { return store_job(group, *admission); });
  group.checks.add(admission->client, [group, call = std::move(call), admission](const std::stop_token& stop) mutable {
    group.answers.with(std::move(call), [&] {
      check(group, *admission, stop);
      return store_job(group, *admission);
    });
  });
}

void on_submit(const SubmitGroup& group, Call call) {
  proto::SubmitParams submit = proto::read_submit(call.params);
  NewJob job{submit.key,
             {submit.priority, submit.not_before, submit.start_by, submit.max_runtime_s,
              submit.queue.empty() ? default_queue : submit.queue},
             proto::write_json(to_json(submit.spec)),
             submit.spec.cell_bundle,
             0,
             call.session->owner()};
  // Those who have no name are told apart by their connection.
  const std::string client =
      job.owner.empty() ? std::to_string(reinterpret_cast<std::uintptr_t>(call.session.get())) : job.owner;
  const auto admission =
      std::make_shared<Admission>(Admission{std::move(submit), client, group.config.check_time, std::move(job), {}});
  group.admission.add([group, call = std::make_shared<Call>(std::move(call)),
                       admission](const std::stop_token&) mutable { admit(group, std::move(call), admission); });
}

}  // namespace

Handlers submit_handlers(const SubmitGroup& group) {
  return {
      {"job.submit", [group](Call call) { on_submit(group, std::move(call)); }},
  };
}

}  // namespace sculpt::server
