#include "server/results/isolated_timing.hpp"

#include "server/run/child_question.hpp"

namespace sculpt::server {

void time_in_child(const StoredSpec& stored, const Isolation& isolation, const std::stop_token& stop) {
  ask_about_result(stored, isolation, {time_job_option, "timed the job"}, stop);
}

int run_isolated_timing(const Planner& planner) {
  return answer_parent(FolderUse::write, [&](const DescribedJob& described, const Job& job) {
    planner.time(job, described.folder() / "trajectory.ndjson", described.folder() / law_file);
    return Json::object();
  });
}

}  // namespace sculpt::server
