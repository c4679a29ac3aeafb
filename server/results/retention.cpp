#include "server/results/retention.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "proto/cell_bundle.hpp"
#include "server/base/crash_point.hpp"
#include "server/run/job_run.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

constexpr int page = 100;

std::uint64_t folder_bytes(const fs::path& folder) {
  std::uint64_t bytes = 0;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, error)) {
    std::error_code gone;
    const std::uintmax_t size = entry.is_regular_file(gone) ? entry.file_size(gone) : 0;
    if (!gone) bytes += size;
  }
  return bytes;
}

template <typename Visit>
void for_each_job(JobStore& store, Visit visit) {
  JobWindow window{.limit = page};
  for (bool more = true; more;) {
    const JobPage found = store.list(window);
    // What it needs is not known.
    if (!found.damaged.empty()) throw StorageError(found.damaged.front().why);
    for (const JobRecord& job : found.jobs) visit(job);
    more = found.more;
    if (more) window.after = found.jobs.back().id;
  }
}

}  // namespace

std::vector<std::string> Retention::sweep(const RetentionRules& rules, std::uint64_t now_ms) {
  std::vector<std::string> removed = remove_jobs(rules, now_ms);
  remove_leftovers();
  blobs_.remove_unused(needed_blobs(), rules.blob_age);
  return removed;
}

// In the order of their ends.
std::vector<std::string> Retention::remove_jobs(const RetentionRules& rules, std::uint64_t now_ms) {
  struct Finished {
    std::string id, finished_at;
    bool pinned = false;
    std::uint64_t bytes = 0;
  };
  std::vector<Finished> finished;
  std::uint64_t bytes = 0;
  for_each_job(store_, [&](const JobRecord& job) {
    if (!is_final(job.state)) return;
    finished.push_back({job.id, job.finished_at, job.pinned, folder_bytes(artifacts_.job_folder(job.id))});
    bytes += finished.back().bytes;
  });
  std::ranges::stable_sort(finished, {}, &Finished::finished_at);
  const std::string oldest = utc_text(now_ms - std::min(now_ms, static_cast<std::uint64_t>(rules.age.count())));
  std::vector<std::string> removed;
  for (const Finished& job : finished) {
    const bool due = job.finished_at < oldest || (bytes > rules.bytes && job.bytes > 0);
    if (job.pinned || !due || !store_.remove(job.id)) continue;
    bytes -= job.bytes;
    removed.push_back(job.id);
    spdlog::info("job={} removed with {} bytes: its time of keeping is over", job.id, job.bytes);
    crash_point(CrashPoint::job_removed);
  }
  return removed;
}

// Of the jobs just removed, and what a crash or a stop left.
void Retention::remove_leftovers() {
  std::vector<std::string> folders;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(jobs_, error))
    folders.push_back(entry.path().filename());
  for (const std::string& job : folders) artifacts_.discard_leftovers(job);
  crash_point(CrashPoint::files_removed);
}

std::set<std::string> Retention::needed_blobs() {
  std::set<std::string> needed;
  for_each_job(store_, [&](const JobRecord& job) {
    const proto::JobSpec spec = read_stored_spec(job);
    needed.insert(spec.mesh.sha256);
    if (spec.stock_mesh) needed.insert(spec.stock_mesh->sha256);
    for (const proto::ClampingSpec& clamping : spec.clampings) needed.insert(clamping.left);
    if (!needed.insert(job.cell_bundle).second) return;
    for (const auto& [reference, sha256] : proto::read_cell_bundle(blobs_.read(job.cell_bundle, "")).files)
      needed.insert(sha256);
  });
  return needed;
}

}  // namespace sculpt::server
