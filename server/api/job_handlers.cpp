// What is asked of jobs: one, a page of them, their end, a replay, their cell.
#include "proto/crc32.hpp"
#include "server/api/handlers.hpp"
#include "server/api/job_page.hpp"
#include "server/results/job_cell.hpp"
#include "server/run/isolated_replay.hpp"
#include "server/run/job_run.hpp"

namespace sculpt::server {
namespace {

ViewSources view_sources(const JobGroup& group) {
  return {group.store, group.scheduler, group.config.keep};
}

// Its time of keeping may end while the replay waits for its turn.
Replay replay_stored(const JobGroup& group, const JobRecord& job, const std::stop_token& stop) try {
  group.artifacts.check_whole(job, "trajectory");
  fetch_blobs(job, group.blobs);
  return replay_in_child({job.spec, job.cell_bundle, job.id, 0, job.inherited, job.folder}, group.isolation, stop);
} catch (const std::exception&) {
  find_job(group.store, job.id);
  throw;
}

Answer replay(const JobGroup& group, const JobRecord& job, const std::stop_token& stop) {
  const Replay replay = replay_stored(group, job, stop);
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

void on_get(const JobGroup& group, Call call) {
  const std::string job = proto::read_job_id(call.params);
  group.answers.read(std::move(call),
                     [sources = view_sources(group), job] { return job_view(sources, find_job(sources.store, job)); });
}

void on_list(const JobGroup& group, Call call) {
  const proto::ListParams list = proto::read_list(call.params);
  const std::size_t max_line = call.session->max_line();
  group.answers.read(std::move(call),
                     [sources = view_sources(group), list, max_line] { return job_page(sources, list, max_line); });
}

void on_wait(const JobGroup& group, Call call) {
  const proto::WaitParams wait = proto::read_wait(call.params);
  group.waits.add(std::move(call), wait.job, wait.timeout_s);
}

void on_report(const JobGroup& group, Call call) {
  const std::string job = proto::read_job_id(call.params);
  call.session->hold();
  group.answers.from(group.disk, std::move(call), [group, job](const std::stop_token&) {
    return Answer{proto::parse_json(group.artifacts.read_whole(find_job(group.store, job), "report")), std::nullopt};
  });
}

void on_verify(const JobGroup& group, Call call) {
  const std::string id = proto::read_job_id(call.params);
  group.answers.detour(
      group.reads, std::move(call),
      [&store = group.store, id](const std::stop_token&) {
        JobRecord job = find_job(store, id);
        if (store.artifacts(id).empty()) {
          throw proto::ProtocolError("wrong_state",
                                     "job " + id + " is " + name(job.state) + " and has no final trajectory to replay");
        }
        return job;
      },
      [group](Call known, const JobRecord& job) {
        group.answers.from(group.replays, std::move(known),
                           [group, job](const std::stop_token& stop) { return replay(group, job, stop); });
      });
}

Answer read_cell_piece(const JobGroup& group, const proto::CellReadParams& wanted) {
  const std::string file = find_cell_file(group.store, group.blobs, {wanted.job, wanted.file});
  const std::uint64_t size = group.blobs.size(file, {});
  if (wanted.offset > size)
    throw proto::ProtocolError(
        "params_invalid",
        "offset " + std::to_string(wanted.offset) + " is beyond the file's " + std::to_string(size) + " bytes",
        "/params/offset");
  std::string bytes = group.blobs.read_piece(file, wanted.offset, wanted.bytes);
  Json result{{"job", wanted.job},
              {"file", file},
              {"offset", wanted.offset},
              {"bytes", bytes.size()},
              {"size", size},
              {"eof", wanted.offset + bytes.size() == size},
              {"crc32", proto::crc32_hex(bytes)}};
  return {std::move(result), std::move(bytes)};
}

void on_cell(const JobGroup& group, Call call) {
  const proto::CellReadParams wanted = proto::read_cell_read(call.params);
  call.session->hold();
  group.answers.from(group.disk, std::move(call),
                     [group, wanted](const std::stop_token&) { return read_cell_piece(group, wanted); });
}

}  // namespace

Handlers job_handlers(const JobGroup& group) {
  return {
      {"job.get", [group](Call call) { on_get(group, std::move(call)); }},
      {"job.list", [group](Call call) { on_list(group, std::move(call)); }},
      {"job.wait", [group](Call call) { on_wait(group, std::move(call)); }},
      {"job.report", [group](Call call) { on_report(group, std::move(call)); }},
      {"job.verify", [group](Call call) { on_verify(group, std::move(call)); }},
      {"job.cell", [group](Call call) { on_cell(group, std::move(call)); }},
  };
}

}  // namespace sculpt::server
