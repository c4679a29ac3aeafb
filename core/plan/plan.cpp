#include "core/plan/plan.hpp"

#include <sys/resource.h>

#include <fstream>
#include <utility>

#include "core/base/helpers.hpp"
#include "core/base/run_context.hpp"
#include "core/base/sha256.hpp"
#include "core/base/stopwatch.hpp"
#include "core/material/octree.hpp"
#include "core/motion/explain_residue.hpp"
#include "core/plan/carve.hpp"
#include "core/plan/checkpoint/checkpoint_folder.hpp"
#include "core/plan/intake.hpp"
#include "core/plan/job_key.hpp"
#include "core/plan/mill_plan.hpp"
#include "core/plan/replay_beside.hpp"
#include "core/plan/report_figures.hpp"
#include "core/plan/run_log.hpp"
#include "core/sweep/follow.hpp"
#include "core/trajectory/quantum.hpp"
#include "core/trajectory/reader.hpp"
#include "core/verify/home_contacts.hpp"
#include "core/verify/mill/verify_milled.hpp"
#include "core/verify/verify.hpp"

namespace sculpt {
namespace {

constexpr double tolerance_voxels = 0.02;

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

/// A translating robot has one tool direction only; what `sweep` is for an arm, `octree` is for it.
Search search_for(const Job& job, const Chain& chain) {
  return chain.translating() && job.search == Search::sweep ? Search::octree : job.search;
}

TrajectoryHeader make_header(const Job& job, Search search, const Cell& cell, const Chain& chain, const Grid& grid) {
  TrajectoryHeader header;
  header.joints = chain.names();
  header.home = rounded(cell.home(chain), chain.lower(), chain.upper());
  header.grid = grid;
  header.tool = make_tool(cell.tool, grid.voxel_m);
  header.tolerance_m = (search == Search::sweep ? max_ball_deviation : tolerance_voxels) * grid.voxel_m;
  header.cell = cell.name;
  header.search = name(search);
  header.seed = job.seed;
  header.held = chain.translating() && !job.allow_freed;
  return header;
}

/// Goes on with the file where the checkpoint was; what an arm needs to know of it goes to `carved`.
Output open_output(const OutputTask& task, const Checkpoint& at, Carved& carved, const Watch& watch) {
  if (at.file.bytes == 0) return {task, watch};
  const bool is_needed = !task.chain.translating() && !at.residue;
  const std::uint64_t by_sweep = at.sweeping ? at.file.keyframes : at.swept ? at.swept->keyframes : 0;
  const auto visit = [&, swept = by_sweep](const Keyframe& keyframe) mutable {
    if (!is_needed) return;
    if (swept == 0) return carved.by_arm.push_back(keyframe);
    --swept;
    carved.q = keyframe.q;
    if (keyframe.cut) carved.standing.erase(keyframe.first, keyframe.last);
  };
  return {task, at.file, visit, watch};
}

void name_job(Report& report, const Job& job) {
  report.mesh = job.mesh.name;
  report.robot = job.cell.name;
  report.seed = job.seed;
  report.resolution = job.resolution;
  report.threads = job.threads;
}

void count_search(Report& report, const Checkpoint& now) {
  report.sweep = now.sweep_figures;
  report.quality.ompl_calls = now.arm.ompl_calls;
  report.quality.ompl_solved = now.arm.ompl_solved;
}

/// What is read and made of a job before anything is planned; figures of it go to the report of `result`, the voxels
/// to `result` itself.
struct Inputs {
  Cell cell;
  Octree octree;
};

Inputs read_inputs(const Job& job, Watch& watch, JobResult& result) {
  Report& report = result.report;
  const Stopwatch load;
  watch.step(Stage::load, 0, 1);
  CheckedJob checked = check_job(job, watch);
  result.grid = checked.grid;
  report.seconds.load = load.seconds();

  const Stopwatch voxelizing;
  result.voxels = std::move(checked.shapes).take_voxels(checked.grid, watch);
  report.seconds.voxelize = voxelizing.seconds();

  const Stopwatch building;
  Octree octree = build_octree(result.voxels, watch);
  watch.doubts = find_doubts(result.voxels, result.grid);
  count_voxels(report, result.voxels, watch.doubts, octree);
  watch.step(Stage::plan, 0, report.voxels.remove);
  report.seconds.octree = building.seconds();
  return {std::move(checked.cell), std::move(octree)};
}

/// What the planner and the replay make of the cell, each by itself: for links that are meshes that takes a while.
struct Surroundings {
  std::optional<Scene> scene;
  std::vector<LinkPair> home_contacts;  ///< as the replay sees them

  Surroundings(const Cell& cell, const Grid& grid, const VoxelSet& stock, const Helpers& helpers) {
    helpers.for_each_index(2, [&](std::size_t part) {
      if (part == 0) scene.emplace(cell, grid, stock);
      if (part == 1) home_contacts = find_home_contacts(cell, cell.chain().joints());
    });
  }
};

/// Home must be free for the planner and for the replay, which find out by themselves what may touch.
void check_home(const Surroundings& around, const Cell& cell, const Configuration& home) {
  if (const std::string contact = around.scene->describe_contact(home); !contact.empty())
    throw InputError("cell_invalid", "cell '" + cell.name + "': at home " + contact +
                                         ": choose a home clear of the full stock, the room and itself");
  if (!around.home_contacts.empty())
    throw InputError("cell_invalid",
                     "cell '" + cell.name + "': " + describe_home_contact(cell.robot, around.home_contacts.front()));
}

/// Fields depend on the material where it is not the whole grid: those are not kept.
FieldStore field_store(const Job& job, Search search) {
  const bool whole_grid = !job.stock.box && !job.stock.mesh && job.clampings.empty();
  if (job.keep_fields.empty() || !whole_grid || search != Search::sweep) return {};
  return {job.keep_fields, field_key(job.cell, job.resolution, job.seed)};
}

/// Why what is left was left; found out once a plan.
const std::vector<Residue>& explain(const Scene& scene, const CarveTask& task, RunLog& log, const RunContext& run) {
  if (!log.now().residue) {
    const bool any_may_fall = scene.chain().translating() && !task.header.held;
    log.end_plan(
        explain_residue(scene, task.atlas, task.voxels, any_may_fall ? task.voxels.stock : task.may_fall, run));
  }
  return *log.now().residue;
}

/// The file is whole.
void finish(Output& output, ReplayBeside& replay, Report& report) {
  report.plan_sha256 = output.finish().sha256;
  replay.end();
}

JobResult plan(const Job& job, const OutputPlace& place, const Watch& told, CheckpointFolder kept) {
  const Stopwatch total;
  const Helpers helpers(job.threads);
  Watch watch = told;
  std::stop_source stop;  // of the planning; a finding of the replay stops it too
  watch.stop = stop.get_token();
  const std::stop_callback pass_on(told.stop, [&stop] { stop.request_stop(); });
  const RunContext run{job.seed, helpers, watch};
  JobResult result;
  Report& report = result.report;
  const auto [cell, octree] = read_inputs(job, watch, result);

  const Stopwatch planning;
  Surroundings around(cell, result.grid, result.voxels.stock, helpers);
  Scene& scene = *around.scene;
  const Search search = search_for(job, scene.chain());
  report.search = name(search);
  list_unchecked_links(report, scene);
  const TrajectoryHeader header = make_header(job, search, cell, scene.chain(), result.grid);
  check_home(around, cell, header.home);
  const VoxelSet may_fall = find_unheld(result.voxels);
  const PostureAtlas atlas(scene.chain(), result.grid, job.seed);
  Checkpoint now = kept.find_newest().value_or(Checkpoint{});
  ReplayBeside replay({place.trajectory, cell, result.voxels, job.threads}, now.replayed,
                      [&stop] { stop.request_stop(); });
  Carved carved{result.voxels.stock, header.home, {}};
  const OutputTask written{place, header, scene.chain(), result.voxels, report.voxels.remove, job.threads};
  Output output = open_output(written, now, carved, watch);
  output.tell_of_growth([&replay] { replay.grow(); });
  RunLog log(kept, now, output, &replay, &scene);
  try {
    const CarveTask task{result.voxels, octree, may_fall, header, atlas, field_store(job, search), search};
    if (!now.residue) carve(scene, task, carved, log, run);
    count_search(report, now);
    finish(output, replay, report);
    count_path(report, output.figures(), result.grid.voxel_m, log.checks());
    result.residue = explain(scene, task, log, run);
    count_residue(report, result.residue);
    report.seconds.plan = planning.seconds();

    const Stopwatch verifying;
    count_replay(report, replay.wait(watch, [&log] { log.note_replay(); }));
    report.seconds.verify = verifying.seconds();
  } catch (const Cancelled&) {
    if (!replay.alarmed() || told.stop.stop_requested()) {
      log.save_at_stop();
      throw;
    }
    if (report.plan_sha256.empty()) finish(output, replay, report);
    count_replay(report, replay.wait({told.stop, told.tell, watch.doubts}, [] {}));
  }
  report.seconds.total = total.seconds();
  return result;
}

JobResult run(const Job& job, const OutputPlace& place, const Watch& watch, CheckpointFolder kept) {
  JobResult result = job.search == Search::mill ? plan_milled(job, place, watch, std::move(kept))
                                                : plan(job, place, watch, std::move(kept));
  name_job(result.report, job);
  result.report.peak_memory_bytes = peak_memory_bytes();
  return result;
}

}  // namespace

VoxelSet find_left(const JobResult& result) {
  VoxelSet left = result.voxels.keep;
  for (const Residue& voxel : result.residue) left.insert(voxel.voxel);
  return left;
}

Verdict replay_plan(std::istream& in, const Job& job, const Watch& watch, const ReplaySettings& settings) {
  const bool is_milled = TrajectoryReader(in).header().mill.has_value();
  in.clear();
  in.seekg(0);
  Cell cell = parse_cell(job.cell);
  const Grid grid = cell.grid(job.resolution);
  JobShapes shapes(job);
  if (!is_milled) return verify_trajectory(in, cell, std::move(shapes).take_voxels(grid, watch), watch, settings);
  const MilledPart part{shapes.place_part(grid, watch), sha256_hex(job.mesh.bytes)};
  return verify_milled(in, without_holder(std::move(cell)), std::move(shapes).take_voxels(grid, watch), part,
                       settings.threads, watch);
}

JobResult run_job(const Job& job, const std::filesystem::path& trajectory, const Watch& watch, TrajectoryForm form) {
  return run(job, {trajectory, form}, watch, {});
}

JobResult resume_job(const Job& job, const std::filesystem::path& trajectory, const CheckpointPlace& place,
                     const Watch& watch) {
  return run(job, {trajectory, TrajectoryForm::text, place.timeline}, watch,
             {place.folder, trajectory, job_key(job), place.interval});
}

}  // namespace sculpt
