#include "server/events/job_view.hpp"

#include "server/run/job_run.hpp"

namespace sculpt::server {
namespace {

std::string expiry(const JobRecord& job, std::chrono::milliseconds keep) {
  return utc_text(unix_ms_of(job.finished_at) + static_cast<std::uint64_t>(keep.count()));
}

}  // namespace

Json progress_view(const Progress& progress) {
  Json view{{"stage", name(progress.stage)}, {"done", progress.done}, {"total", progress.total}};
  const Doubts& doubts = progress.doubts;
  if (doubts.loose_keep > 0) {
    view["loose_keep"] = doubts.loose_keep;
    view["keep"] = doubts.keep;
  }
  if (doubts.ambiguous > 0) {
    view["ambiguous"] = doubts.ambiguous;
    view["ambiguous_at_mm"] = doubts.ambiguous_at_mm;
  }
  return view;
}

Json error_view(const JobRecord& job) {
  return {{"code", job.error_code}, {"message", job.error_sentence}};
}

Json job_view(const ViewSources& sources, const JobRecord& job) {
  const proto::JobSpec spec = read_stored_spec(job);
  Json view{{"job", job.id}, {"state", name(job.state)}};
  if (!job.key.empty()) view["key"] = job.key;
  if (!job.owner.empty()) view["owner"] = job.owner;
  view["priority"] = job.schedule.priority;
  if (job.schedule.queue != default_queue) view["queue"] = job.schedule.queue;
  view["mesh"] = spec.mesh.name;
  if (spec.continued) view["continues"] = spec.continued->job;
  view["robot"] = spec.cell_bundle.empty() ? spec.robot : "cell bundle " + spec.cell_bundle.substr(0, 8);
  view["search"] = spec.search.value_or(name(spec.mill ? Search::mill : Job{}.search));
  view["seed"] = spec.seed;
  view["resolution"] = spec.resolution;
  view["attempt"] = job.attempt;
  if (!job.schedule.not_before.empty()) view["not_before"] = job.schedule.not_before;
  if (!job.schedule.start_by.empty()) view["start_by"] = job.schedule.start_by;
  if (job.schedule.max_runtime_s > 0) view["max_runtime_s"] = job.schedule.max_runtime_s;
  if (!job.wake_at.empty()) view["until"] = job.wake_at;
  view["submitted_at"] = job.submitted_at;
  if (!job.started_at.empty()) view["started_at"] = job.started_at;
  if (!job.finished_at.empty()) view["finished_at"] = job.finished_at;
  if (job.pinned) view["pinned"] = true;
  if (is_final(job.state) && !job.pinned) view["expires_at"] = expiry(job, sources.keep);
  if (job.state == JobState::queued) view["position"] = sources.store.position(job);
  if (const std::optional<Progress> progress = sources.scheduler.progress(job.id)) {
    view["progress"] = progress_view(*progress);
  }
  if (!job.error_code.empty()) view["error"] = error_view(job);
  return view;
}

}  // namespace sculpt::server
