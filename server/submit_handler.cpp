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

// Runs on the admission thread. A repeated submit is answered from the store: it must work even when its cell is gone
// since.
Answer admit(Services& services, const SubmitParams& submit, const std::string& owner, const std::stop_token& stop) {
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
  services.planner.check(planned, Watch{stop, {}});
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
  answer_from(services.admission, services, std::move(call), [&services, submit, owner](const std::stop_token& stop) {
    return admit(services, *submit, owner, stop);
  });
}

}  // namespace sculpt
