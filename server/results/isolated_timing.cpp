#include "server/results/isolated_timing.hpp"

#include "server/run/child_question.hpp"

namespace sculpt::server {

void time_in_child(const StoredSpec& stored, const Isolation& isolation, const std::stop_token& stop) {
  const ChildAnswer answer = ask_child(stored, isolation, time_job_option, std::nullopt, stop);
  if (!answer.said)
    throw std::runtime_error("the process that timed the job ended with " +
                             (answer.end.empty() ? "no word" : answer.end));
  rethrow_reported(*answer.said);
}

int run_isolated_timing(const Planner& planner) {
  return answer_parent(FolderUse::write, [&](const DescribedJob& described, const Job& job) {
    planner.time(job, described.folder() / "trajectory.ndjson", described.folder() / law_file);
    return Json::object();
  });
}

}  // namespace sculpt::server
