#include "server/detour.hpp"
#include "server/handlers.hpp"
#include "server/isolated_replay.hpp"
#include "server/job_page.hpp"

namespace sculpt {
namespace {

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
  const std::string job = read_job_id(call.params);
  answer_read(services, std::move(call),
              [sources = view_sources(services), job] { return job_view(sources, find_job(sources.store, job)); });
}

void on_list(Services& services, Call call) {
  const ListParams list = read_list(call.params);
  const std::size_t max_line = call.session->max_line();
  answer_read(services, std::move(call),
              [sources = view_sources(services), list, max_line] { return job_page(sources, list, max_line); });
}

void on_wait(Services& services, Call call) {
  const WaitParams wait = read_wait(call.params);
  services.waits.add(std::move(call), wait.job, wait.timeout_s);
}

void on_report(Services& services, Call call) {
  const std::string job = read_job_id(call.params);
  call.session->hold();
  answer_from(services.disk, services, std::move(call), [&services, job](const std::stop_token&) {
    return Answer{parse_json(services.artifacts.read_whole(find_job(services.store, job), "report")), std::nullopt};
  });
}

void on_verify(Services& services, Call call) {
  const std::string id = read_job_id(call.params);
  detour(
      services.reads, services, std::move(call),
      [&store = services.store, id](const std::stop_token&) {
        JobRecord job = find_job(store, id);
        if (store.artifacts(id).empty()) {
          throw ProtocolError("wrong_state",
                              "job " + id + " is " + name(job.state) + " and has no final trajectory to replay");
        }
        return job;
      },
      [&services](Call known, const JobRecord& job) {
        answer_from(services.replays, services, std::move(known),
                    [&services, job](const std::stop_token& stop) { return replay(services, job, stop); });
      });
}

}  // namespace sculpt
