#include "server/http/metrics.hpp"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "proto/version.hpp"

namespace sculpt::server {
namespace {

constexpr std::array<Stage, 6> stages{Stage::load, Stage::voxelize, Stage::octree,
                                      Stage::plan, Stage::verify,   Stage::write};

std::string head(const std::string& name, const char* type, const char* help) {
  return fmt::format("# HELP {} {}\n# TYPE {} {}\n", name, help, name, type);
}

template <class Number>
std::string single(const std::string& name, const char* type, const char* help, Number value) {
  return head(name, type, help) + fmt::format("{} {}\n", name, value);
}

std::uint64_t resident_bytes() {
  std::ifstream in("/proc/self/statm");
  std::uint64_t all = 0, resident = 0;
  in >> all >> resident;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

std::uint64_t free_bytes(const std::filesystem::path& folder) {
  std::error_code failed;
  const auto space = std::filesystem::space(folder, failed);
  return failed ? 0 : space.available;
}

std::string queue_text(const MetricSources& sources) {
  std::string text = head("sculptd_jobs", "gauge", "Jobs by state.");
  const auto counts = sources.store.counts();
  for (const JobState state : job_states)
    text += fmt::format("sculptd_jobs{{state=\"{}\"}} {}\n", name(state), counts.at(state));
  text += single("sculptd_queue_age_seconds", "gauge", "How long ago the oldest queued job was submitted.",
                 sources.store.queue_age_s());
  text += single("sculptd_workers", "gauge", "Jobs that can run at once.", sources.workers);
  text += head("sculptd_stage_seconds", "histogram", "Time that jobs stayed in a stage.");
  for (const Stage stage : stages) {
    const Histogram& times = sources.counters.stage_times[static_cast<std::size_t>(stage)];
    text += times.text("sculptd_stage_seconds", fmt::format("stage=\"{}\"", name(stage)));
  }
  return text;
}

std::string connections_text(const MetricSources& sources, std::size_t open) {
  const Counters& counters = sources.counters;
  return single("sculptd_connections", "gauge", "Open connections.", open) +
         single("sculptd_connections_total", "counter", "Connections accepted.", counters.connections.load()) +
         single("sculptd_requests_total", "counter", "Requests taken.", counters.requests.load()) +
         single("sculptd_events_total", "counter", "Events sent to subscribers.", counters.events.load()) +
         single("sculptd_received_bytes_total", "counter", "Bytes taken from connections.", counters.bytes_in.load()) +
         single("sculptd_sent_bytes_total", "counter", "Bytes given to connections.", counters.bytes_out.load());
}

std::string storage_text(const MetricSources& sources, const std::filesystem::path& data) {
  return head("sculptd_commit_seconds", "histogram", "Time of a commit of the store, with its sync to disk.") +
         sources.store.commit_times().text("sculptd_commit_seconds", "") +
         single("sculptd_disk_free_bytes", "gauge", "Free space where the data folder is.", free_bytes(data));
}

std::string fleet_text(FleetStore& fleet) {
  const DatabaseFigures figures = fleet.figures();
  return single("sculptd_leases_lost_total", "counter", "Runs that were ended because their lease was lost.",
                fleet.leases_lost()) +
         single("sculptd_late_ends_total", "counter", "Ends of runs that were dropped: the job was another's by then.",
                fleet.late_ends()) +
         single("sculptd_database_oldest_transaction_seconds", "gauge",
                "Age of the oldest transaction in the database; while it is open claims become slower.",
                figures.oldest_transaction_s) +
         single("sculptd_database_dead_rows", "gauge", "Dead rows of the table of jobs.", figures.dead_rows);
}

std::string process_text(const MetricSources& sources) {
  const std::chrono::duration<double> uptime = std::chrono::steady_clock::now() - sources.started;
  return head("sculptd_build_info", "gauge", "Always 1; the label says which build runs.") +
         fmt::format("sculptd_build_info{{server=\"{}\"}} 1\n", proto::server_name) +
         single("sculptd_uptime_seconds", "gauge", "Time since the start.", uptime.count()) +
         single("process_resident_memory_bytes", "gauge", "Memory in use.", resident_bytes());
}

}  // namespace

std::string metrics_text(const MetricSources& sources, std::size_t connections, const std::filesystem::path& data) {
  return queue_text(sources) + connections_text(sources, connections) + storage_text(sources, data) +
         (sources.fleet == nullptr ? "" : fleet_text(*sources.fleet)) + process_text(sources);
}

}  // namespace sculpt::server
