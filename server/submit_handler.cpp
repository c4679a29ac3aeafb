#include <spdlog/spdlog.h>

#include "server/crash_point.hpp"
#include "server/handlers.hpp"
#include "server/services.hpp"
#include "server/session.hpp"

namespace sculpt {
namespace {

Answer submit_answer(const Submitted& submitted) {
  return {{{"job", submitted.job.id}, {"state", name(submitted.job.state)}, {"duplicate", submitted.duplicate}},
          std::nullopt};
}

// Runs on the thread of admission or probes. A repeated submit is answered from the store: it must work even when its
// cell is gone since.
Answer admit(Services& services, const SubmitParams& submit, const std::string& owner,
             std::chrono::milliseconds check_time, const std::stop_token& stop) {
  NewJob job{submit.key,
             {submit.priority, submit.not_before, submit.start_by, submit.max_runtime_s},
             write_json(to_json(submit.spec)),
             submit.spec.cell_bundle,
             0,
             owner};
  if (!submit.key.empty() && services.store.find_key(submit.key)) return submit_answer(services.store.submit(job));
  if (job.cell_bundle.empty())
    job.cell_bundle = store_cell(services.planner.read_cell(submit.spec.robot), services.blobs);
  const Job planned = to_job(submit.spec, job.cell_bundle, services.blobs, services.defaults);
  if (services.known_files.has(submit.spec)) {
    services.planner.check(planned, Watch{stop, {}});
  } else {
    check_in_child({job.spec, job.cell_bundle}, services.isolation, check_time, stop);
    services.known_files.add(submit.spec);
  }
  job.memory_bytes = services.planner.predict_memory(planned);
  const Submitted submitted = services.store.submit(job);
  crash_point(CrashPoint::submit_stored);
  spdlog::info("job={} {} mesh={} resolution={}", submitted.job.id, name(submitted.job.state), submit.spec.mesh.name,
               submit.spec.resolution);
  services.scheduler.wake();
  return submit_answer(submitted);
}

}  // namespace

void on_submit(Services& services, Call call) {
  const auto submit = std::make_shared<const SubmitParams>(read_submit(call.params));
  const std::string owner = call.session->owner();
  TaskQueue& queue = services.known_files.has(submit->spec) ? services.admission : services.probes;
  answer_from(queue, services, std::move(call),
              [&services, submit, owner, check_time = services.config.check_time](const std::stop_token& stop) {
                return admit(services, *submit, owner, check_time, stop);
              });
}

}  // namespace sculpt
