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

}  // namespace

JobResult plan_milled(const Job& job, const OutputPlace& place, const Watch& told) {
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
  Output output({place, header, chain, result.voxels, report.voxels.remove, job.threads}, watch);
  const MillJob milled{inputs.cell,  result.grid,          result.voxels, inputs.part,
                       inputs.tools, wishes_of(*job.mill), header.home,   change};
  const MillResult done = mill(
      milled, [&](std::vector<Keyframe> keyframes) { output.add(std::move(keyframes)); }, run);
  report.plan_sha256 = output.finish().sha256;
  report.tools = done.tools;
  report.cures = done.cures;
  count_path(report, output.figures(), result.grid.voxel_m, 0);
  result.residue = find_residue(result.voxels, done.left);
  count_residue(report, result.residue);
  report.seconds.plan = planning.seconds();

  const Stopwatch verifying;
  std::ifstream in(place.trajectory, std::ios::binary);
  const Verdict verdict =
      verify_milled(in, inputs.cell, result.voxels, {inputs.part, header.mill->mesh_sha256}, job.threads, watch);
  count_replay(report, verdict);
  count_surface(report, *verdict.surface, done.reachable, job.mill->tolerance_m);
  report.seconds.verify = verifying.seconds();
  report.seconds.total = total.seconds();
  return result;
}

}  // namespace sculpt
