#include "server/handlers.hpp"
#include "server/isolated_replay.hpp"
#include "server/job_view.hpp"
#include "server/session.hpp"

namespace sculpt {
namespace {

// Of a reply line, for everything around the jobs of a list.
constexpr std::size_t room_for_envelope = 200;

Answer replay(Services& services, const JobRecord& job, const std::stop_token& stop) {
  services.artifacts.check_whole(job, "trajectory");
  const Replay replay = replay_in_child({job.spec, job.cell_bundle, job.id}, services.isolation, stop);
  Json findings = Json::array();
  for (const Finding& finding : replay.findings)
    findings.push_back({{"line", finding.line}, {"sentence", finding.sentence}});
  Json exempt = Json::array();
  for (const ExemptPair& pair : replay.exempt_pairs)
    exempt.push_back({{"links", {pair.first, pair.second}}, {"why", pair.why}});
  return {{{"job", job.id},
           {"clean", replay.clean},
           {"collisions", replay.collisions},
           {"voxels_checked", replay.voxels_checked},
           {"findings", std::move(findings)},
           {"exempt_pairs", std::move(exempt)}},
          std::nullopt};
}

}  // namespace

void on_get(Services& services, Call call) {
  const JobRecord job = find_job(services.store, read_job_id(call.params));
  answer(call, job_view(services, job));
}

void on_list(Services& services, Call call) {
  const ListParams list = read_list(call.params);
  // One more than asked for says whether there are more. A list that would be too long for the client is cut.
  const std::vector<JobRecord> jobs = services.store.list(list.after, list.limit + 1);
  Json views = Json::array();
  std::size_t bytes = 0;
  for (const JobRecord& job : jobs) {
    Json view = job_view(services, job);
    bytes += write_json(view).size() + 1;
    const bool full = bytes + room_for_envelope > call.session->max_line() && !views.empty();
    if (full || views.size() == static_cast<std::size_t>(list.limit)) break;
    views.push_back(std::move(view));
  }
  const bool more = views.size() < jobs.size();
  answer(call, {{"jobs", std::move(views)}, {"more", more}});
}

void on_wait(Services& services, Call call) {
  const WaitParams wait = read_wait(call.params);
  find_job(services.store, wait.job);
  services.waits.add(std::move(call), wait.job, wait.timeout_s);
}

void on_report(Services& services, Call call) {
  const JobRecord job = find_job(services.store, read_job_id(call.params));
  call.session->hold();
  answer_from(services.disk, services, std::move(call), [&services, job](const std::stop_token&) {
    return Answer{parse_json(services.artifacts.read_whole(job, "report")), std::nullopt};
  });
}

void on_verify(Services& services, Call call) {
  const JobRecord job = find_job(services.store, read_job_id(call.params));
  if (services.store.artifacts(job.id).empty()) {
    throw ProtocolError("wrong_state",
                        "job " + job.id + " is " + name(job.state) + " and has no final trajectory to replay");
  }
  answer_from(services.replays, services, std::move(call),
              [&services, job](const std::stop_token& stop) { return replay(services, job, stop); });
}

}  // namespace sculpt
