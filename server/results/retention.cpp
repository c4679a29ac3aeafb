#include "server/results/retention.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "server/base/crash_point.hpp"
#include "server/files/shared_files.hpp"
#include "server/run/job_run.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

constexpr int page = 100;
constexpr std::chrono::hours copy_age{1};

std::set<std::string> shared_blobs(const std::set<std::string>& hashes) {
  std::set<std::string> names;
  for (const std::string& hash : hashes) names.insert(shared_blob(hash));
  return names;
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
  if (SharedFiles* shared = files().shared())
    shared->remove_unused(shared_blobs(needed_blobs()), rules.blob_age);
  else
    blobs_.remove_unused(needed_blobs(), rules.blob_age);
  return removed;
}

void Retention::drop_copies(const RetentionRules& rules) {
  if (files().shared() == nullptr) return;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(files().folder(), error)) {
    const std::string job = entry.path().filename();
    artifacts_.discard_leftovers(job);
    const std::optional<JobRecord> record = store_.find(job);
    if (record && is_final(record->state)) files().drop_copies(job, copy_age);
  }
  blobs_.remove_unused({}, rules.blob_age);  // the rest is fetched again when it is used
}

// In the order of their ends.
std::vector<std::string> Retention::remove_jobs(const RetentionRules& rules, std::uint64_t now_ms) {
  struct Finished {
    std::string id, finished_at;
    bool pinned = false;
    std::uint64_t bytes = 0;
  };
  const auto bytes_of = files().sizes();
  std::vector<Finished> finished;
  std::uint64_t bytes = 0;
  for_each_job(store_, [&](const JobRecord& job) {
    if (!is_final(job.state)) return;
    finished.push_back({job.id, job.finished_at, job.pinned, bytes_of(job.id)});
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
  for (const std::string& job : files().jobs()) artifacts_.discard_leftovers(job);
  crash_point(CrashPoint::files_removed);
}

std::set<std::string> Retention::needed_blobs() {
  std::set<std::string> needed;
  std::set<std::string> bundles;
  for_each_job(store_, [&](const JobRecord& job) { needed.merge(blobs_of(job, blobs_, bundles)); });
  return needed;
}

}  // namespace sculpt::server
