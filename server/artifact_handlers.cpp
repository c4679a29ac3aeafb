#include "proto/crc32.hpp"
#include "server/handlers.hpp"
#include "server/job_view.hpp"
#include "server/session.hpp"

namespace sculpt {
namespace {

Answer read_chunk(const Artifacts& artifacts, const ArtifactReadParams& wanted, WholeRead& so_far) {
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
              {"crc32", crc32_hex(chunk.bytes)}};
  return {std::move(result), std::move(chunk.bytes)};
}

}  // namespace

void on_artifact_list(Services& services, Call call) {
  const JobRecord job = find_job(services.store, read_job_id(call.params));
  call.session->hold();
  answer_from(services.disk, services, std::move(call), [&services, job](const std::stop_token&) {
    return Answer{{{"job", job.id}, {"artifacts", services.artifacts.list(job)}}, std::nullopt};
  });
}

void on_artifact_pin(Services& services, Call call) {
  const PinParams pin = read_pin(call.params);
  find_job(services.store, pin.job);
  services.store.pin(pin.job, pin.pinned);
  answer(call, {{"job", pin.job}, {"pinned", pin.pinned}});
}

void on_artifact_read(Services& services, Call call) {
  const ArtifactReadParams wanted = read_artifact_read(call.params);
  find_job(services.store, wanted.job);
  const bool to_export = services.artifacts.needs_export(wanted);
  call.session->hold();  // so that nobody else goes on with so_far
  const std::shared_ptr<WholeRead> so_far = call.session->whole_read();
  answer_from(to_export ? services.exports : services.disk, services, std::move(call),
              [&artifacts = services.artifacts, wanted, to_export, so_far](const std::stop_token&) {
                if (to_export) artifacts.make_export(wanted);
                return read_chunk(artifacts, wanted, *so_far);
              });
}

}  // namespace sculpt
