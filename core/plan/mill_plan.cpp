#include "core/plan/mill_plan.hpp"

#include <fstream>

#include "core/base/helpers.hpp"
#include "core/base/run_context.hpp"
#include "core/base/sha256.hpp"
#include "core/base/stopwatch.hpp"
#include "core/mill/map/assembly.hpp"
#include "core/mill/mill.hpp"
#include "core/plan/intake.hpp"
#include "core/plan/report_figures.hpp"
#include "core/plan/run_log.hpp"
#include "core/trajectory/quantum.hpp"
#include "core/verify/home_contacts.hpp"
#include "core/verify/mill/verify_milled.hpp"

namespace sculpt {
namespace {

struct MillInputs {
  Cell cell;
  std::vector<MillTool> tools;
  Mesh part;
};

MillInputs read_mill_inputs(const Job& job, Watch& watch, JobResult& result) {
  Report& report = result.report;
  const Stopwatch load;
  watch.step(Stage::load, 0, 1);
  CheckedJob checked = check_job(job, watch);
  result.grid = checked.grid;
  Mesh part = checked.shapes.place_part(checked.grid, watch);
  report.seconds.load = load.seconds();
  const Stopwatch voxelizing;
  result.voxels = std::move(checked.shapes).take_voxels(checked.grid, watch);
  report.seconds.voxelize = voxelizing.seconds();
  const Stopwatch building;
  const Octree octree = build_octree(result.voxels, watch);
  watch.doubts = find_doubts(result.voxels, result.grid);
  count_voxels(report, result.voxels, watch.doubts, octree);
  report.seconds.octree = building.seconds();
  return {without_holder(std::move(checked.cell)), std::move(checked.tools), std::move(part)};
}

MillWishes wishes_of(const MillOrder& order) {
  return {order.tolerance_m, order.scallop(), order.allowance()};
}

TrajectoryHeader make_header(const Job& job, const MillInputs& inputs, const Grid& grid, const Chain& chain) {
  TrajectoryHeader header;
  header.joints = chain.names();
  header.home = rounded(inputs.cell.home(chain), chain.lower(), chain.upper());
  header.grid = grid;
  header.tolerance_m = job.mill->tolerance_m;
  header.cell = inputs.cell.name;
  header.search = name(Search::mill);
  header.seed = job.seed;
  header.mill = {inputs.tools, mill_directions(), wishes_of(*job.mill).stray_m(), sha256_hex(job.mesh.bytes)};
  return header;
}

/// At home and where it is changed no tool may touch anything, also before the first cut.
void check_home(const Cell& cell, const std::vector<MillTool>& tools, const Grid& grid, const VoxelSet& stock) {
  for (const MillTool& tool : tools) {
    const Cell carried = carrying(cell, tool);
    const Scene scene(carried, grid, stock);
    if (const std::string contact = scene.describe_contact(cell.home(scene.chain())); !contact.empty())
      throw InputError("tools_invalid", "with tool '" + tool.name + "' at home " + contact +
                                            ": choose a home farther from the stock, or a shorter tool");
    if (const std::string contact = scene.describe_contact(cell.change_place(scene.chain())); !contact.empty())
      throw InputError("tools_invalid", "with tool '" + tool.name + "' where tools are changed " + contact +
                                            ": choose another tool_change in the cell file");
    if (const auto contacts = find_home_contacts(carried, scene.chain().joints()); !contacts.empty())
      throw InputError("cell_invalid", "cell '" + cell.name + "' with tool '" + tool.name +
                                           "': " + describe_home_contact(carried.robot, contacts.front()));
  }
}

std::vector<Residue> find_residue(const VoxelGrid& voxels, VoxelSet left) {
  left -= voxels.keep;
  std::vector<Residue> residue;
  for_each_voxel(left, [&](Voxel v) { residue.push_back({v, Reason::tool_cannot_reach}); });
  return residue;
}

/// Goes on with the file where the checkpoint was; what is to be cut again goes to `cuts`.
Output open_output(const OutputTask& task, const Checkpoint& at, CutList& cuts, const Watch& watch) {
  if (at.file.bytes == 0) return {task, watch};
  const auto visit = [&](const Keyframe& keyframe) {
    if (at.milling) cuts.add(keyframe);
  };
  return {task, at.file, visit, watch};
}

/// Until all is cut, which the log knows then.
void mill_on(const MillJob& job, CutList cuts, RunLog& log, const RunContext& run) {
  if (log.now().milled) return;
  std::optional<MillStart> start;
  if (log.now().milling) start = {*log.now().milling, cuts.take()};
  MillResult done = mill(job, std::move(start), log.hear_mill(), run);
  log.end_milling(
      {std::move(done.tools), std::move(done.cures), excess_figures(std::move(done.reachable), job.wishes.tolerance_m)},
      find_residue(job.voxels, std::move(done.left)));
}

/// A replay takes longer than a checkpoint may wait.
Watch keeping(RunLog& log, const Watch& watch) {
  Watch both = watch;
  both.tell = [&log, tell = watch.tell](const Progress& at) {
    log.save_if_due();
    if (tell) tell(at);
  };
  return both;
}

}  // namespace

JobResult plan_milled(const Job& job, const OutputPlace& place, const Watch& told, CheckpointFolder kept) {
  const Stopwatch total;
  const Helpers helpers(job.threads);
  Watch watch = told;
  const RunContext run{job.seed, helpers, watch};
  JobResult result;
  Report& report = result.report;
  report.search = name(Search::mill);
  const MillInputs inputs = read_mill_inputs(job, watch, result);

  const Stopwatch planning;
  const Cell first = carrying(inputs.cell, inputs.tools.front());
  const Chain chain = first.chain();
  const TrajectoryHeader header = make_header(job, inputs, result.grid, chain);
  const Configuration change = rounded(inputs.cell.change_place(chain), chain.lower(), chain.upper());
  check_home(inputs.cell, inputs.tools, result.grid, result.voxels.stock);
  Checkpoint now = kept.find_newest().value_or(Checkpoint{});
  CutList cuts;
  Output output =
      open_output({place, header, chain, result.voxels, report.voxels.remove, job.threads}, now, cuts, watch);
  RunLog log(kept, now, output);
  const MillJob milled{inputs.cell,  result.grid,          result.voxels, inputs.part,
                       inputs.tools, wishes_of(*job.mill), header.home,   change};
  try {
    mill_on(milled, std::move(cuts), log, run);
    report.plan_sha256 = output.finish().sha256;
    report.tools = now.milled->tools;
    report.cures = now.milled->cures;
    count_path(report, output.figures(), result.grid.voxel_m, 0);
    result.residue = *now.residue;
    count_residue(report, result.residue);
    report.seconds.plan = planning.seconds();

    const Stopwatch verifying;
    std::ifstream in(place.trajectory, std::ios::binary);
    const Verdict verdict = verify_milled(in, inputs.cell, result.voxels, {inputs.part, header.mill->mesh_sha256},
                                          job.threads, keeping(log, watch));
    count_replay(report, verdict);
    count_surface(report, *verdict.surface, now.milled->reachable, job.mill->tolerance_m);
    report.seconds.verify = verifying.seconds();
  } catch (const Cancelled&) {
    log.save_at_stop();
    throw;
  }
  report.seconds.total = total.seconds();
  return result;
}

}  // namespace sculpt
