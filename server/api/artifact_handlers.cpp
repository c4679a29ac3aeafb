// What clients ask of results: a list, a piece, a link, to be kept.
#include "proto/crc32.hpp"
#include "server/api/handlers.hpp"
#include "server/base/time_stamp.hpp"

namespace sculpt::server {
namespace {

Answer read_chunk(const Artifacts& artifacts, const proto::ArtifactReadParams& wanted, WholeRead& so_far) {
  ArtifactChunk chunk = artifacts.read(wanted, so_far);
  const bool eof = chunk.final && wanted.offset + chunk.bytes.size() == chunk.size;
  Json result{{"job", wanted.job},
              {"artifact", wanted.artifact},
              {"format", chunk.format},
              {"offset", wanted.offset},
              {"bytes", chunk.bytes.size()},
              {"size", chunk.size},
              {"final", chunk.final},
              {"eof", eof},
              {"crc32", proto::crc32_hex(chunk.bytes)}};
  if (wanted.program) result["sha256"] = chunk.sha256;
  return {std::move(result), std::move(chunk.bytes)};
}

void on_artifact_list(const ArtifactGroup& group, Call call) {
  const std::string job = proto::read_job_id(call.params);
  call.session->hold();
  group.answers.from(group.disk, std::move(call), [group, job](const std::stop_token&) {
    return Answer{{{"job", job}, {"artifacts", group.artifacts.list(find_job(group.store, job))}}, std::nullopt};
  });
}

void on_artifact_pin(const ArtifactGroup& group, Call call) {
  const proto::PinParams pin = proto::read_pin(call.params);
  call.session->hold();
  group.answers.from(group.changes, std::move(call), [&store = group.store, pin](const std::stop_token&) {
    find_job(store, pin.job);
    store.pin(pin.job, pin.pinned);
    return Answer{{{"job", pin.job}, {"pinned", pin.pinned}}, std::nullopt};
  });
}

void on_artifact_link(const ArtifactGroup& group, Call call) {
  const proto::ArtifactReadParams wanted = proto::read_artifact_link(call.params);
  group.answers.read(std::move(call), [group, wanted] {
    find_job(group.store, wanted.job);
    const std::string name = download_name(wanted);
    const std::string ticket = group.tickets.issue(wanted);
    const auto end_ms = unix_ms() + std::chrono::duration_cast<std::chrono::milliseconds>(ticket_time).count();
    return Json{{"job", wanted.job},
                {"artifact", wanted.artifact},
                {"path", links_path + ticket + "/" + name},
                {"expires_at", utc_text(end_ms)}};
  });
}

void on_artifact_read(const ArtifactGroup& group, Call call) {
  const proto::ArtifactReadParams wanted = proto::read_artifact_read(call.params);
  call.session->hold();  // so that nobody else goes on with so_far
  std::shared_ptr<WholeRead>& so_far_here = call.session->whole_read();
  if (!so_far_here) so_far_here = std::make_shared<WholeRead>();
  group.answers.read_then(
      std::move(call),
      [group, wanted] {
        find_job(group.store, wanted.job);
        return group.artifacts.needs_export(wanted);
      },
      [group, wanted, so_far = so_far_here](Call known, bool to_export) {
        TaskQueue& maker = find_form(wanted).in_child() ? group.programs : group.exports;
        group.answers.from(to_export ? maker : group.disk, std::move(known),
                           [&artifacts = group.artifacts, wanted, to_export, so_far](const std::stop_token& stop) {
                             if (to_export) artifacts.make_export(wanted, stop);
                             return read_chunk(artifacts, wanted, *so_far);
                           });
      });
}

}  // namespace

Handlers artifact_handlers(const ArtifactGroup& group) {
  return {
      {"artifact.list", [group](Call call) { on_artifact_list(group, std::move(call)); }},
      {"artifact.read", [group](Call call) { on_artifact_read(group, std::move(call)); }},
      {"artifact.link", [group](Call call) { on_artifact_link(group, std::move(call)); }},
      {"artifact.pin", [group](Call call) { on_artifact_pin(group, std::move(call)); }},
  };
}

}  // namespace sculpt::server
