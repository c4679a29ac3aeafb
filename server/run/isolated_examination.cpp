#include "server/run/isolated_examination.hpp"

#include "server/run/child_question.hpp"

namespace sculpt::server {
namespace {

[[noreturn]] void refuse_cell(const std::string& why) {
  throw InputError("cell_invalid", "the examination of the cell " + why +
                                       ": reduce its collision meshes, or repair them; `sculpt cell` examines it on "
                                       "your own machine");
}

}  // namespace

Json examine_in_child(const std::string& cell_bundle, int resolution, const Isolation& isolation,
                      std::chrono::milliseconds patience, const std::stop_token& stop) {
  StoredSpec question{proto::write_json({{"resolution", resolution}}), cell_bundle};
  question.time_s = std::chrono::ceil<std::chrono::seconds>(patience).count();
  const ChildAnswer answer = ask_child(question, isolation, check_cell_option, patience, stop);
  if (answer.too_late) refuse_cell("did not end within " + std::to_string(question.time_s) + " s (check_s)");
  if (!answer.said) refuse_cell("ended with " + (answer.end.empty() ? "no word" : answer.end));
  rethrow_reported(*answer.said);
  return *answer.said;
}

int run_isolated_examination(const Planner& planner) {
  return answer_parent([&](const DescribedJob& described) {
    const int resolution = proto::parse_json(described.job.spec).at("resolution");
    return proto::parse_json(planner.examine(load_cell_and_confine(described), resolution, described.defaults.threads));
  });
}

}  // namespace sculpt::server
