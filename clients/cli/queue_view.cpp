#include "clients/cli/queue_view.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "clients/cli/job_end.hpp"

namespace sculpt {

namespace {

constexpr int bar_cells = 12;

bool stands_still(const Json& job) {
  return !job.contains("progress");
}

std::string text(const Json& object, const char* field) {
  const auto found = object.find(field);
  if (found == object.end()) return "-";
  return found->is_string() ? found->get<std::string>() : found->dump();
}

std::string progress_text(const Json& job) {
  if (stands_still(job)) return "";
  const Json& progress = job["progress"];
  const auto done = progress.value("done", std::uint64_t{0}), total = progress.value("total", std::uint64_t{0});
  const int share = total == 0 ? 0 : static_cast<int>(100 * std::min(done, total) / total);
  const int full = share * bar_cells / 100;
  char line[96];
  std::snprintf(line, sizeof line, "[%s%s] %3d%% %.16s", std::string(full, '#').c_str(),
                std::string(bar_cells - full, '.').c_str(), share, text(progress, "stage").c_str());
  return line;
}

std::string job_line(const Json& job) {
  char line[512];
  std::snprintf(line, sizeof line, "%-26.26s  %-10.10s  %4.4s  %-20.20s  %5.5s  %s", text(job, "job").c_str(),
                text(job, "state").c_str(), text(job, "priority").c_str(), text(job, "mesh").c_str(),
                text(job, "resolution").c_str(), progress_text(job).c_str());
  return line;
}

std::string uptime_text(std::uint64_t seconds) {
  char text[64];
  std::snprintf(text, sizeof text, "%llud %02llu:%02llu:%02llu", static_cast<unsigned long long>(seconds / 86400),
                static_cast<unsigned long long>(seconds / 3600 % 24),
                static_cast<unsigned long long>(seconds / 60 % 60), static_cast<unsigned long long>(seconds % 60));
  return text;
}

std::vector<std::string> head_lines(const Json& server) {
  std::string counts;
  for (const auto& [state, count] : server.at("jobs").items())
    if (count != 0) counts += (counts.empty() ? "" : ", ") + count.dump() + " " + state;
  return {text(server, "server") + ", up " + uptime_text(server.at("uptime_s")) + ", " + text(server, "workers") +
              " workers",
          "jobs: " + (counts.empty() ? "none" : counts), "",
          "JOB                         STATE        PRIO  MESH                      N  PROGRESS"};
}

}  // namespace

Json OpenJobs::read(Client& client) {
  refresh(client);
  add_new(client);
  std::vector<Json> jobs;
  for (const auto& [id, job] : open_) jobs.push_back(job);
  std::ranges::stable_partition(jobs, [](const Json& job) { return !stands_still(job); });
  return jobs;
}

void OpenJobs::refresh(Client& client) {
  for (auto entry = open_.begin(); entry != open_.end();) {
    try {
      entry->second = client.call("job.get", {{"job", entry->first}});
    } catch (const ServerError&) {  // it is not there any more
      entry = open_.erase(entry);
      continue;
    }
    entry = is_final(text(entry->second, "state")) ? open_.erase(entry) : std::next(entry);
  }
}

void OpenJobs::add_new(Client& client) {
  for (bool more = true; more;) {
    Json params{{"limit", 1000}};
    if (!last_seen_.empty()) params["after"] = last_seen_;
    const Json page = client.call("job.list", params);
    for (const Json& job : page.at("jobs")) {
      last_seen_ = job.at("job");
      if (!is_final(text(job, "state"))) open_[last_seen_] = job;
    }
    more = page.value("more", false) && !page.at("jobs").empty();
  }
}

Json read_queue(Client& client, OpenJobs& jobs) {
  return {{"server", client.call("server.info")}, {"jobs", jobs.read(client)}};
}

std::string queue_text(const Json& queue, int columns, int rows) {
  std::vector<std::string> lines = head_lines(queue.at("server"));
  for (const Json& job : queue.at("jobs")) lines.push_back(job_line(job));
  if (rows > 0 && lines.size() > static_cast<std::size_t>(rows)) {
    const std::size_t left_out = lines.size() - static_cast<std::size_t>(rows) + 1;
    lines.resize(static_cast<std::size_t>(rows) - 1);
    lines.push_back("... and " + std::to_string(left_out) + " more");
  }
  std::string all;
  for (const std::string& line : lines)
    all += (columns > 0 ? line.substr(0, static_cast<std::size_t>(columns)) : line) + "\n";
  return all;
}

}  // namespace sculpt
