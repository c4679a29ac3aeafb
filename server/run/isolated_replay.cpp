#include "server/run/isolated_replay.hpp"

#include "server/run/child_question.hpp"

namespace sculpt::server {
namespace {

Json to_json(const Replay& replay) {
  Json findings = Json::array();
  for (const Finding& finding : replay.findings) findings.push_back({finding.line, finding.sentence});
  Json exempt = Json::array();
  for (const ExemptPair& pair : replay.exempt_pairs) exempt.push_back({pair.first, pair.second, pair.why});
  return {{"clean", replay.clean},
          {"collisions", replay.collisions},
          {"voxels_checked", replay.voxels_checked},
          {"findings", std::move(findings)},
          {"exempt_pairs", std::move(exempt)}};
}

Replay read_replay(const Json& said) {
  Replay replay{said.at("clean"), said.at("collisions"), said.at("voxels_checked"), {}, {}};
  for (const Json& finding : said.at("findings")) replay.findings.push_back({finding.at(0), finding.at(1)});
  for (const Json& pair : said.at("exempt_pairs")) replay.exempt_pairs.push_back({pair.at(0), pair.at(1), pair.at(2)});
  return replay;
}

}  // namespace

Replay replay_in_child(const StoredSpec& stored, const Isolation& isolation, const std::stop_token& stop) {
  const ChildAnswer answer = ask_child(stored, isolation, replay_job_option, std::nullopt, stop);
  if (!answer.said)
    throw std::runtime_error("the process that replayed the job ended with " +
                             (answer.end.empty() ? "no word" : answer.end));
  rethrow_reported(*answer.said);
  return read_replay(*answer.said);
}

int run_isolated_replay(const Planner& planner) {
  return answer_parent(FolderUse::read, [&](const DescribedJob& described, const Job& job) {
    return to_json(planner.verify(job, described.folder() / "trajectory.ndjson", {}));
  });
}

}  // namespace sculpt::server
