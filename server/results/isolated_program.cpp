#include "server/results/isolated_program.hpp"

#include "server/run/child_question.hpp"

namespace sculpt::server {

void program_in_child(StoredSpec stored, const ProgramQuestion& question, const Isolation& isolation,
                      const std::stop_token& stop) {
  stored.asked = {{"program", to_json(question.spec)}, {"file", question.file}};
  ask_about_result(std::move(stored), isolation, {program_job_option, "wrote the program"}, stop);
}

int run_isolated_program(const Planner& planner) {
  return answer_parent(FolderUse::write, [&](const DescribedJob& described, const Job& job) {
    const proto::ProgramSpec spec = proto::read_program({described.asked.at("program"), "/params/program"});
    planner.program(job, to_program_demands(spec), described.folder() / "trajectory.ndjson",
                    described.folder() / described.asked.at("file").get<std::string>());
    return Json::object();
  });
}

}  // namespace sculpt::server
