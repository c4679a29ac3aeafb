#include <spdlog/spdlog.h>

#include "server/crash_point.hpp"
#include "server/handlers.hpp"
#include "server/isolated_check.hpp"
#include "server/services.hpp"
#include "server/session.hpp"

namespace sculpt {
namespace {

/// A submit on its way: what the client wants, and the job that comes of it.
struct Admission {
  SubmitParams submit;
  std::string client;  ///< whose checks stand in one line
  std::chrono::milliseconds check_time;
  NewJob job;
  std::string check_key;
};

Answer store_job(Services& services, const Admission& admission) {
  const Submitted submitted = services.store.submit(admission.job);
  crash_point(CrashPoint::submit_stored);
  spdlog::info("job={} {} mesh={} resolution={}", submitted.job.id, name(submitted.job.state),
               admission.submit.spec.mesh.name, admission.submit.spec.resolution);
  services.scheduler.wake();
  return {{{"job", submitted.job.id}, {"state", name(submitted.job.state)}, {"duplicate", submitted.duplicate}},
          std::nullopt};
}

// All that can be said of the job by its spec and the sizes of its files. True if it is known to pass its check, or is
// known itself: a repeated submit is answered from the store, also when its cell is gone since.
bool prepare(Services& services, Admission& admission) {
  NewJob& job = admission.job;
  if (!job.key.empty() && services.store.find_key(job.key)) return true;
  const JobSpec& spec = admission.submit.spec;
  if (job.cell_bundle.empty()) job.cell_bundle = store_cell(services.planner.read_cell(spec.robot), services.blobs);
  const JobSizes sizes = measure(spec, job.cell_bundle, services.blobs);
  check_sizes(sizes, services.defaults.memory_cap_bytes);
  job.memory_bytes = services.planner.predict_memory(sizes);
  admission.check_key = check_key(spec, job.cell_bundle, services.defaults);
  return services.passed.has(admission.check_key);
}

void check(Services& services, const Admission& admission, const std::stop_token& stop) {
  if (services.passed.has(admission.check_key)) return;  // since it began to wait
  check_in_child({admission.job.spec, admission.job.cell_bundle}, services.isolation, admission.check_time, stop);
  services.passed.add(admission.check_key);
}

// On the thread of admission. Whoever needs a check waits for that at the desk, out of the way of the others.
void admit(Services& services, std::shared_ptr<Call> call, const std::shared_ptr<Admission>& admission) {
  bool known = false;
  try {
    known = prepare(services, *admission);
  } catch (...) {
    return answer_with(services, std::move(call), []() -> Answer { throw; });
  }
  if (known) return answer_with(services, std::move(call), [&] { return store_job(services, *admission); });
  services.checks.add(admission->client,
                      [&services, call = std::move(call), admission](const std::stop_token& stop) mutable {
                        answer_with(services, std::move(call), [&] {
                          check(services, *admission, stop);
                          return store_job(services, *admission);
                        });
                      });
}

}  // namespace

void on_submit(Services& services, Call call) {
  SubmitParams submit = read_submit(call.params);
  NewJob job{submit.key,
             {submit.priority, submit.not_before, submit.start_by, submit.max_runtime_s},
             write_json(to_json(submit.spec)),
             submit.spec.cell_bundle,
             0,
             call.session->owner()};
  // Those who have no name are told apart by their connection.
  const std::string client =
      job.owner.empty() ? std::to_string(reinterpret_cast<std::uintptr_t>(call.session.get())) : job.owner;
  const auto admission =
      std::make_shared<Admission>(Admission{std::move(submit), client, services.config.check_time, std::move(job), {}});
  services.admission.add([&services, call = std::make_shared<Call>(std::move(call)),
                          admission](const std::stop_token&) mutable { admit(services, std::move(call), admission); });
}

}  // namespace sculpt
