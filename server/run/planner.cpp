#include "server/run/planner.hpp"

#include <fstream>

#include "core/cell/shipped_cells.hpp"
#include "core/doctor/examine.hpp"
#include "core/doctor/findings_json.hpp"
#include "core/material/binvox.hpp"
#include "core/plan/output/job_time.hpp"
#include "core/plan/output/stock_files.hpp"
#include "core/plan/output/surface_file.hpp"
#include "core/program/make_program.hpp"
#include "core/trajectory/export.hpp"
#include "server/files/zip_writer.hpp"

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

std::ifstream open_plan(const fs::path& trajectory) {
  std::ifstream in(trajectory, std::ios::binary);
  if (!in) throw InputError("trajectory_invalid", "the stored trajectory of the job cannot be read");
  return in;
}

Replay verify(const Job& job, const fs::path& trajectory, const Watch& watch) {
  std::ifstream in = open_plan(trajectory);
  Verdict verdict = replay_plan(in, job, watch, {job.threads});
  return {verdict.clean, verdict.collisions, verdict.voxels_checked, std::move(verdict.findings),
          std::move(verdict.exempt_pairs)};
}

PlanPath read_path(const fs::path& trajectory) {
  std::ifstream in(trajectory, std::ios::binary);
  return PlanPath(in);
}

MotionDemands demands_of(const Job& job, const PlanPath& path) {
  const auto& mill = path.header().mill;
  return demands_of(*job.motion, mill ? mill->tools : std::vector<MillTool>{});
}

void write_file(const fs::path& file, const std::function<void(std::ostream&)>& write) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  write(out);
  out.close();
  if (!out) throw InputError("file_unwritable", "cannot write '" + file.string() + "': check the free space");
}

void time(const Job& job, const fs::path& trajectory, const fs::path& law) {
  const PlanPath path = read_path(trajectory);
  const TimedPlan plan = time_plan(path, parse_cell(job.cell), demands_of(job, path));
  write_file(law, [&](std::ostream& out) { write_law(out, plan.law, mark_of(path)); });
}

void program(const Job& job, const ProgramDemands& wanted, const fs::path& trajectory, const fs::path& zip) {
  const PlanPath path = read_path(trajectory);
  ProgramDemands demands = wanted;
  demands.motion = demands_of(job, path);
  write_file(zip, [&](std::ostream& out) {
    ZipWriter writer(out);
    make_program(path, parse_cell(job.cell), demands,
                 [&](const ProgramFile& file) { writer.add(demands.name + "/" + file.name, file.text); });
    writer.finish();
  });
}

void surface(const Job& job, const fs::path& trajectory, const fs::path& ply) {
  std::ifstream plan = open_plan(trajectory);
  write_file(ply, [&](std::ostream& out) { write_machined_surface(job, plan, out, {}); });
}

void stocks(const Job& job, const fs::path& trajectory, const fs::path& zip) {
  std::ifstream plan = open_plan(trajectory);
  write_file(zip, [&](std::ostream& out) {
    ZipWriter writer(out);
    give_stocks(job, plan, [&](const std::string& name, const std::string& binvox) { writer.add(name, binvox); }, {});
    writer.finish();
  });
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
  planner.tool_libraries = [folders] { return read_tool_libraries(tool_folders(folders)); };
  planner.check = check_job;
  planner.examine = examine;
  planner.predict_memory = predict_memory;
  planner.run = run;
  planner.verify = verify;
  planner.time = time;
  planner.program = program;
  planner.surface = surface;
  planner.stocks = stocks;
  planner.to_csv = export_csv;
  planner.to_binary = export_binary;
  return planner;
}

}  // namespace sculpt::server
