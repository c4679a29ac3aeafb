#include "clients/cli/job_end.hpp"

#include <iostream>
#include <utility>

#include "clients/cli/exit_code.hpp"
#include "clients/cli/report_table.hpp"

namespace sculpt::cli {

namespace {

/// As `server/job_view` writes them.
Doubts read_doubts(const Json& progress) {
  return {progress.value("keep", std::uint64_t{0}), progress.value("loose_keep", std::uint64_t{0}),
          progress.value("ambiguous", std::uint64_t{0}), progress.value("ambiguous_at_mm", std::array<double, 3>{})};
}

}  // namespace

Json follow_job(client::Client& client, const std::string& job, ProgressLine& progress) {
  client.when_lost([&progress](const std::string& sentence) { progress.say(sentence); });
  client.subscribe(job);
  bool warned = false;
  for (bool ended = false; !ended;) {
    const Json event = *client.next_event();
    const std::string type = event.value("type", "");
    if (event.value("job", "") != job || !event.contains("data")) continue;
    const Json& data = event["data"];
    if (type == "progress") {
      const std::vector<std::string> lines = doubt_lines(read_doubts(data));
      if (!lines.empty() && !std::exchange(warned, true))
        for (const std::string& line : lines) progress.say(line);
      progress.tell(data.value("stage", ""), data.value("done", std::uint64_t{0}),
                    data.value("total", std::uint64_t{0}));
    } else if (type == "state") {
      const std::string to = data.value("to", "");
      const std::string reason = data.value("reason", "");
      progress.say(reason == "interrupted" ? to + " again: the daemon was stopped while it ran" : to);
      if (!client::is_final(to)) continue;
      ended = client::is_final(client.call("job.get", {{"job", job}}).value("state", ""));
      if (!ended) client.subscribe(job, event.value("seq", std::uint64_t{0}));  // quarantined, and retried since
    }
  }
  progress.clear();
  client.when_lost({});
  return client.call("job.get", {{"job", job}});
}

Json wait_job(client::Client& client, const std::string& job) {
  constexpr int max_wait_s = 3600;
  while (client.call("job.wait", {{"job", job}, {"timeout_s", max_wait_s}}).value("timed_out", false)) {
  }
  return client.call("job.get", {{"job", job}});
}

int end_exit_code(const Json& job) {
  const std::string state = job.value("state", "");
  const std::string id = job.value("job", "");
  if (state == "succeeded") return exit_fine;
  const Json error = job.value("error", Json::object());
  if (state == "cancelled")
    std::cerr << "sculpt: cancelled: job " << id << " was cancelled\n";
  else
    std::cerr << "sculpt: " << error.value("code", state) << ": job " << id << " " << state << ": "
              << error.value("message", "see the log of the server") << "\n";
  return exit_failed;
}

}  // namespace sculpt::cli
