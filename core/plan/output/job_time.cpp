#include "core/plan/output/job_time.hpp"

#include <fstream>

namespace sculpt {

std::optional<InputError> time_job(const Job& job, const std::filesystem::path& trajectory, Report& report,
                                   const Watch& watch) {
  if (!job.motion) return {};
  watch.step(Stage::write, 0, 1);
  std::ifstream in(trajectory, std::ios::binary);
  const PlanPath path(in);
  const Cell cell = parse_cell(job.cell);
  MotionDemands demands =
      demands_of(*job.motion, path.header().mill ? path.header().mill->tools : std::vector<MillTool>{});
  std::optional<InputError> not_kept;
  const auto time = [&] { report.time = time_figures(path, time_plan(path, cell, demands, watch.stop)); };
  try {
    time();
  } catch (const InputError& error) {
    if (error.code() != "feed_not_kept") throw;
    not_kept = error;
    demands.keep_feed.reset();
    time();
  }
  watch.step(Stage::write, 1, 1);
  return not_kept;
}

}  // namespace sculpt
