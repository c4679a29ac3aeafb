#include "server/run/isolated_check.hpp"

#include "server/run/child_question.hpp"

namespace sculpt::server {
namespace {

[[noreturn]] void refuse_mesh(const std::string& why) {
  throw InputError("mesh_unreadable", "the reader of its files " + why +
                                          ": the mesh is damaged in a way that it cannot take; repair it, or export it "
                                          "again as binary STL");
}

}  // namespace

void check_in_child(StoredSpec stored, const Isolation& isolation, std::chrono::milliseconds patience,
                    const std::stop_token& stop) {
  stored.time_s = std::chrono::ceil<std::chrono::seconds>(patience).count();
  const ChildAnswer answer = ask_child(stored, isolation, check_job_option, patience, stop);
  if (answer.too_late) refuse_mesh("did not end within " + std::to_string(stored.time_s) + " s (check_s)");
  if (!answer.said) refuse_mesh("ended with " + (answer.end.empty() ? "no word" : answer.end));
  rethrow_reported(*answer.said);
}

int run_isolated_check(const Planner& planner) {
  return answer_parent(FolderUse::none, [&](const DescribedJob&, const Job& job) {
    planner.check(job, {});
    return Json::object();
  });
}

}  // namespace sculpt::server
