// What a driver asks for: where the joints are when.
#include "proto/crc32.hpp"
#include "proto/framing.hpp"
#include "server/api/handlers.hpp"
#include "server/results/programs.hpp"

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
      [&store = group.store, &motions = group.motions, wanted] {
        JobRecord job = find_job(store, wanted.job);
        if (store.artifacts(job.id).empty())
          throw proto::ProtocolError(
              "wrong_state", "job " + job.id + " is " + name(job.state) + " and has no final trajectory to go through");
        check_may_run(job);
        const bool is_kept = motions.has(job, wanted);
        return std::pair(std::move(job), is_kept);
      },
      [group, wanted](Call known, const std::pair<JobRecord, bool>& found) {
        const auto& [job, is_kept] = found;
        group.answers.from(
            is_kept ? group.samples : group.laws, std::move(known),
            [group, wanted, job = job](const std::stop_token& stop) { return read_window(group, job, wanted, stop); });
      });
}

}  // namespace

Handlers sample_handlers(const SampleGroup& group) {
  return {{"job.samples", [group](Call call) { on_samples(group, std::move(call)); }}};
}

}  // namespace sculpt::server
