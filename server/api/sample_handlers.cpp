// What a driver asks for: where the joints are when.
#include "proto/crc32.hpp"
#include "proto/framing.hpp"
#include "server/api/handlers.hpp"

namespace sculpt::server {
namespace {

Answer read_window(const SampleGroup& group, const JobRecord& job, const proto::SamplesParams& wanted,
                   const std::stop_token& stop) {
  SampleWindow window = group.motions.window(job, wanted, proto::max_chunk_bytes, stop);
  Json rests = Json::array();
  for (const PathHold& hold : window.holds) rests.push_back(hold.rest_s);
  Json result{{"job", wanted.job},
              {"joints", window.joints},
              {"rate_hz", wanted.rate_hz},
              {"first", window.first},
              {"count", window.count},
              {"samples", window.samples},
              {"duration_s", window.duration_s},
              {"rests_s", rests},
              {"eof", window.first + window.count == window.samples},
              {"bytes", window.rows.size()},
              {"crc32", proto::crc32_hex(window.rows)}};
  return {std::move(result), std::move(window.rows)};
}

void on_samples(const SampleGroup& group, Call call) {
  const proto::SamplesParams wanted = proto::read_samples(call.params);
  group.answers.read_then(
      std::move(call),
      [&store = group.store, wanted] {
        JobRecord job = find_job(store, wanted.job);
        if (store.artifacts(job.id).empty())
          throw proto::ProtocolError(
              "wrong_state", "job " + job.id + " is " + name(job.state) + " and has no final trajectory to go through");
        if (job.error_code == "verify_failed")
          throw proto::ProtocolError("wrong_state", "the replay of the plan of job " + job.id +
                                                        " found faults, so it must not be run: plan it again");
        return job;
      },
      [group, wanted](Call known, const JobRecord& job) {
        group.answers.from(group.samples, std::move(known), [group, wanted, job](const std::stop_token& stop) {
          return read_window(group, job, wanted, stop);
        });
      });
}

}  // namespace

Handlers sample_handlers(const SampleGroup& group) {
  return {{"job.samples", [group](Call call) { on_samples(group, std::move(call)); }}};
}

}  // namespace sculpt::server
