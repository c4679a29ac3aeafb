#include "clients/cli/queue_view.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "clients/cli/job_end.hpp"

namespace sculpt::cli {

namespace {

/// How the columns share a line.
struct Layout {
  int mesh, resolution, bar;
};
constexpr Layout wide{20, 5, 12}, narrow{13, 4, 0};
constexpr int wide_columns = 103;  ///< that the wide layout takes; the narrow one takes 80

bool stands_still(const Json& job) {
  return !job.contains("progress");
}

std::string text(const Json& object, const char* field) {
  const auto found = object.find(field);
  if (found == object.end()) return "-";
  return found->is_string() ? found->get<std::string>() : found->dump();
}

std::string progress_text(const Json& job, int bar_cells) {
  if (stands_still(job)) return "";
  const Json& progress = job["progress"];
  const auto done = progress.value("done", std::uint64_t{0}), total = progress.value("total", std::uint64_t{0});
  const int share = total == 0 ? 0 : static_cast<int>(100 * std::min(done, total) / total);
  std::string bar;
  if (bar_cells > 0) {
    const int full = share * bar_cells / 100;
    bar = "[" + std::string(static_cast<std::size_t>(full), '#') +
          std::string(static_cast<std::size_t>(bar_cells - full), '.') + "] ";
  }
  char line[64];
  std::snprintf(line, sizeof line, "%3d%% %.8s", share, text(progress, "stage").c_str());
  return bar + line;
}

std::string line_of(const Layout& layout, const std::string& job, const std::string& state, const std::string& priority,
                    const std::string& mesh, const std::string& resolution, const std::string& progress) {
  char line[512];
  std::snprintf(line, sizeof line, "%-26.26s  %-10.10s  %4.4s  %-*.*s  %*.*s  %s", job.c_str(), state.c_str(),
                priority.c_str(), layout.mesh, layout.mesh, mesh.c_str(), layout.resolution, layout.resolution,
                resolution.c_str(), progress.c_str());
  return line;
}

std::string job_line(const Json& job, const Layout& layout) {
  return line_of(layout, text(job, "job"), text(job, "state"), text(job, "priority"), text(job, "mesh"),
                 text(job, "resolution"), progress_text(job, layout.bar));
}

std::string uptime_text(std::uint64_t seconds) {
  char text[64];
  std::snprintf(text, sizeof text, "%llud %02llu:%02llu:%02llu", static_cast<unsigned long long>(seconds / 86400),
                static_cast<unsigned long long>(seconds / 3600 % 24),
                static_cast<unsigned long long>(seconds / 60 % 60), static_cast<unsigned long long>(seconds % 60));
  return text;
}

/// The counts of all states, on as many lines as they take.
std::vector<std::string> count_lines(const Json& counts, int columns) {
  std::vector<std::string> lines{"jobs: "};
  for (const auto& [state, count] : counts.items()) {
    if (count == 0) continue;
    const std::string word = count.dump() + " " + state;
    const bool first = lines.back() == "jobs: ";
    if (!first) lines.back() += ",";
    const bool fits = columns <= 0 || lines.back().size() + 1 + word.size() + 1 <= static_cast<std::size_t>(columns);
    if (first)
      lines.back() += word;
    else if (fits)
      lines.back() += " " + word;
    else
      lines.push_back("      " + word);
  }
  if (lines.back() == "jobs: ") lines.back() += "none";
  return lines;
}

/// A line for each daemon that shares the queue.
std::vector<std::string> fleet_lines(const Json& server) {
  std::vector<std::string> lines;
  for (const Json& daemon : server.value("fleet", Json::array())) {
    char line[256];
    std::snprintf(line, sizeof line, "%-28.28s  %-16.16s  %3d of %3d at work  heard of %.0f s ago",
                  text(daemon, "address").c_str(), text(daemon, "server").c_str(), daemon.value("running", 0),
                  daemon.value("workers", 0), daemon.value("silent_s", 0.0));
    lines.emplace_back(line);
  }
  return lines;
}

std::vector<std::string> head_lines(const Json& server, const Layout& layout, int columns) {
  std::vector<std::string> lines{text(server, "server") + ", up " + uptime_text(server.at("uptime_s")) + ", " +
                                 text(server, "workers") + " workers"};
  for (std::string& line : count_lines(server.at("jobs"), columns)) lines.push_back(std::move(line));
  for (std::string& line : fleet_lines(server)) lines.push_back(std::move(line));
  lines.emplace_back();
  lines.push_back(line_of(layout, "JOB", "STATE", "PRIO", "MESH", "N", "PROGRESS"));
  return lines;
}

}  // namespace

Json OpenJobs::read(client::Client& client) {
  refresh(client);
  add_new(client);
  std::vector<Json> jobs;
  for (const auto& [id, job] : open_) jobs.push_back(job);
  std::ranges::stable_partition(jobs, [](const Json& job) { return !stands_still(job); });
  return jobs;
}

void OpenJobs::refresh(client::Client& client) {
  for (auto entry = open_.begin(); entry != open_.end();) {
    try {
      entry->second = client.call("job.get", {{"job", entry->first}});
    } catch (const client::ServerError&) {  // it is not there any more
      entry = open_.erase(entry);
      continue;
    }
    entry = client::is_final(text(entry->second, "state")) ? open_.erase(entry) : std::next(entry);
  }
}

void OpenJobs::add_new(client::Client& client) {
  for (bool more = true; more;) {
    Json params{{"limit", 1000}};
    if (!last_seen_.empty()) params["after"] = last_seen_;
    const Json page = client.call("job.list", params);
    for (const Json& job : page.at("jobs")) {
      last_seen_ = job.at("job");
      if (!client::is_final(text(job, "state"))) open_[last_seen_] = job;
    }
    more = page.value("more", false) && !page.at("jobs").empty();
  }
}

Json read_queue(client::Client& client, OpenJobs& jobs) {
  return {{"server", client.call("server.info")}, {"jobs", jobs.read(client)}};
}

std::string queue_text(const Json& queue, int columns, int rows) {
  const Layout& layout = columns > 0 && columns < wide_columns ? narrow : wide;
  std::vector<std::string> lines = head_lines(queue.at("server"), layout, columns);
  for (const Json& job : queue.at("jobs")) lines.push_back(job_line(job, layout));
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

}  // namespace sculpt::cli
