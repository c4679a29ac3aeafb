#include "server/run/planner.hpp"

#include <fstream>

#include "core/cell/shipped_cells.hpp"
#include "core/doctor/examine.hpp"
#include "core/doctor/findings_json.hpp"
#include "core/material/binvox.hpp"
#include "core/plan/output/job_time.hpp"
#include "core/trajectory/export.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

PlanFiles run(const Job& job, const fs::path& trajectory, const Watch& watch) {
  CheckpointPlace place{trajectory.parent_path()};
  place.timeline = place.folder / timeline_file;
  JobResult result = resume_job(job, trajectory, place, watch);
  PlanFiles files;
  if (result.report.verify.clean) files.unkept = time_job(job, trajectory, result.report, watch);
  files.report_json = report_json(result.report);
  files.residue_ndjson = residue_ndjson(result.residue);
  files.voxels_binvox = write_binvox(result.voxels.keep, result.grid);
  files.stock_binvox = write_binvox(find_left(result), result.grid);
  files.clean = result.report.verify.clean;
  files.collisions = result.report.verify.collisions;
  if (!result.report.findings.empty()) files.first_finding = result.report.findings.front();
  return files;
}

Replay verify(const Job& job, const fs::path& trajectory, const Watch& watch) {
  std::ifstream in(trajectory, std::ios::binary);
  if (!in) throw InputError("trajectory_invalid", "the stored trajectory of the job cannot be read");
  Verdict verdict = replay_plan(in, job, watch, {job.threads});
  return {verdict.clean, verdict.collisions, verdict.voxels_checked, std::move(verdict.findings),
          std::move(verdict.exempt_pairs)};
}

void time(const Job& job, const fs::path& trajectory, const fs::path& law) {
  std::ifstream in(trajectory, std::ios::binary);
  const PlanPath path(in);
  const auto& mill = path.header().mill;
  const TimedPlan plan =
      time_plan(path, parse_cell(job.cell), demands_of(*job.motion, mill ? mill->tools : std::vector<MillTool>{}));
  std::ofstream out(law, std::ios::binary | std::ios::trunc);
  write_law(out, plan.law, mark_of(path));
  out.close();
  if (!out) throw InputError("file_unwritable", "cannot write '" + law.string() + "': check the free space");
}

std::string examine(const CellFiles& cell, int resolution, int threads) {
  const Helpers helpers(threads);
  const Watch watch;
  return findings_json(examine_files(cell, {resolution}, {0, helpers, watch}));
}

}  // namespace

Planner make_planner(std::vector<fs::path> folders) {
  Planner planner;
  planner.cells = [folders] { return cell_names(folders); };
  planner.read_cell = [folders](const std::string& name) { return read_cell_files(find_cell(name, folders)); };
  planner.check = check_job;
  planner.examine = examine;
  planner.predict_memory = predict_memory;
  planner.run = run;
  planner.verify = verify;
  planner.time = time;
  planner.to_csv = export_csv;
  planner.to_binary = export_binary;
  return planner;
}

}  // namespace sculpt::server
