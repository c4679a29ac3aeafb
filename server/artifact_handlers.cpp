#include "proto/crc32.hpp"
#include "server/detour.hpp"
#include "server/handlers.hpp"

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
  const std::string job = read_job_id(call.params);
  call.session->hold();
  answer_from(services.disk, services, std::move(call), [&services, job](const std::stop_token&) {
    return Answer{{{"job", job}, {"artifacts", services.artifacts.list(find_job(services.store, job))}}, std::nullopt};
  });
}

void on_artifact_pin(Services& services, Call call) {
  const PinParams pin = read_pin(call.params);
  call.session->hold();
  answer_from(services.changes, services, std::move(call), [&store = services.store, pin](const std::stop_token&) {
    find_job(store, pin.job);
    store.pin(pin.job, pin.pinned);
    return Answer{{{"job", pin.job}, {"pinned", pin.pinned}}, std::nullopt};
  });
}

void on_artifact_read(Services& services, Call call) {
  const ArtifactReadParams wanted = read_artifact_read(call.params);
  call.session->hold();  // so that nobody else goes on with so_far
  const std::shared_ptr<WholeRead> so_far = call.session->whole_read();
  read_then(
      services, std::move(call),
      [&services, wanted] {
        find_job(services.store, wanted.job);
        return services.artifacts.needs_export(wanted);
      },
      [&services, wanted, so_far](Call known, bool to_export) {
        answer_from(to_export ? services.exports : services.disk, services, std::move(known),
                    [&artifacts = services.artifacts, wanted, to_export, so_far](const std::stop_token&) {
                      if (to_export) artifacts.make_export(wanted);
                      return read_chunk(artifacts, wanted, *so_far);
                    });
      });
}

}  // namespace sculpt
