#include "core/plan/plan.hpp"

#include <sys/resource.h>

#include <chrono>
#include <fstream>
#include <utility>

#include "core/base/helpers.hpp"
#include "core/material/loose_pieces.hpp"
#include "core/material/octree.hpp"
#include "core/motion/block_carve.hpp"
#include "core/motion/explain_residue.hpp"
#include "core/motion/gantry_carve.hpp"
#include "core/plan/checkpoint_folder.hpp"
#include "core/plan/intake.hpp"
#include "core/plan/job_key.hpp"
#include "core/plan/run_log.hpp"
#include "core/search/voxel_search.hpp"
#include "core/sweep/follow.hpp"
#include "core/sweep/sweep.hpp"
#include "core/trajectory/quantum.hpp"
#include "core/verify/verify.hpp"

namespace sculpt {
namespace {

constexpr int most_effort = 2;
constexpr double tolerance_voxels = 0.02;

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

/// Each keyframe is a unit. `may_fall`: null where any piece may.
void carve_with_gantry(Scene& scene, const VoxelSet& keep, const VoxelSet* may_fall, const TrajectoryHeader& header,
                       RunLog& log, const Watch& watch) {
  const auto emit = [&](const Keyframe& keyframe) {
    log.output.add(keyframe);
    if (!log.due()) return;
    log.note();
    log.save();
  };
  Gantry gantry(scene, header.home, header.seed, watch.stop, emit, log.now.refusals, log.now.file.keyframes,
                [&] { log.go_on(); });
  try {
    carve_with_gantry(gantry, scene, keep, header.home, header.search, may_fall, watch);
  } catch (const Cancelled&) {
    if (gantry.is_on_its_own()) log.note();
    throw;
  }
}

/// `done`: the keyframes of an arm that was here before.
void carve_with_arm(Scene& scene, const VoxelSet& may_fall, const Octree& octree, const BlockGraph& graph,
                    const Configuration& home, std::uint64_t seed, const std::vector<Keyframe>& done, RunLog& log,
                    const Watch& watch) {
  Arm arm(scene, may_fall, home, seed, watch.stop, [&](const Keyframe& keyframe) { log.output.add(keyframe); });
  const Voxel start = arm.at();
  std::vector<BlockTrial>& trials = log.now.trials;
  arm.resume(done, log.now.arm);
  const auto try_block = [&, known = trials.size(), tried = std::size_t{0}](int block, int effort) mutable {
    if (tried < known) return trials[tried++];
    const BlockTrial trial = carve_block(arm, octree.leaves[static_cast<std::size_t>(block)], effort);
    if (watch.stop.stop_requested()) throw Cancelled{};  // it may have been given up early
    if (trial.removed > 0) log.output.flush();
    trials.push_back(trial);
    if (log.keeps()) log.now.arm = arm.memory();
    log.note();
    log.save_if_due();
    return trial;
  };
  order_blocks(octree, graph, start, most_effort, try_block, watch);
  arm.go_home();
  log.now.arm = arm.memory();
}

/// What sweeps left that may still be cut, and of what else stands that which touches it: no more matters to its
/// blocks.
VoxelGrid left_to_cut(const SweepRest& left, const VoxelSet& keep) {
  const Grid bounds{keep.n(), 1, Vec3::Zero()};
  VoxelSet wanted = left.standing;
  wanted -= keep;
  for (const Voxel v : left.out_of_tool_reach) wanted.erase(v);
  VoxelGrid voxels{wanted, VoxelSet(keep.n())};
  for_each_voxel(wanted, [&](Voxel v) {
    for (const Voxel step : face_steps) {
      const Voxel beside = v + step;
      if (!bounds.contains(beside) || !left.standing.contains(beside) || wanted.contains(beside)) continue;
      voxels.stock.insert(beside);
      voxels.keep.insert(beside);
    }
  });
  return voxels;
}

/// A translating robot has one tool direction only; what `sweep` is for an arm, `octree` is for it.
std::string search_for(const Job& job, const Chain& chain) {
  return chain.translating() && job.search == "sweep" ? "octree" : job.search;
}

TrajectoryHeader make_header(const Job& job, const std::string& search, const Cell& cell, const Chain& chain,
                             const Grid& grid) {
  TrajectoryHeader header;
  header.joints = chain.names();
  header.home = rounded(cell.home(chain), chain.lower(), chain.upper());
  header.grid = grid;
  header.tool = make_tool(cell.tool, grid.voxel_m);
  header.tolerance_m = (search == "sweep" ? most_ball_stray : tolerance_voxels) * grid.voxel_m;
  header.cell = cell.name;
  header.search = search;
  header.seed = job.seed;
  header.held = chain.translating() && !job.allow_freed;
  return header;
}

void count_voxels(Report& report, const VoxelGrid& voxels, const Doubts& doubts, const Octree& octree) {
  const auto n = static_cast<std::uint64_t>(voxels.n());
  const std::uint64_t stock = voxels.stock.size();
  report.voxels.total = n * n * n;
  report.voxels.air = report.voxels.total - stock;
  report.voxels.keep = voxels.keep.size();
  report.voxels.remove = stock - report.voxels.keep;
  report.voxels.loose_keep = doubts.loose_keep;
  if (doubts.loose_keep > 0) report.voxels.loose_keep_pieces = count_pieces(find_loose(voxels.keep));
  report.voxels.ambiguous = doubts.ambiguous;
  report.octree.leaves = octree.leaves.size();
  for (const Block& block : octree.leaves)
    if (block.label == Label::remove) ++report.octree.remove_leaves;
}

void count_path(Report& report, const PathFigures& figures, double voxel_m, std::uint64_t checks) {
  report.path = {figures.keyframes, figures.rows,     figures.transits,
                 figures.cut_m,     figures.travel_m, figures.joint_travel_rad};
  report.voxels.removed = figures.removed;
  report.quality.turns = figures.turns;
  if (figures.removed == 0) return;
  const auto removed = static_cast<double>(figures.removed);
  report.quality.moves_per_voxel = (figures.cut_m + figures.travel_m) / (voxel_m * removed);
  report.quality.checks_per_voxel = static_cast<double>(checks) / removed;
}

void list_unchecked_links(Report& report, const Scene& scene) {
  const auto name = [&](int link) { return scene.chain().robot().links[static_cast<std::size_t>(link)].name; };
  for (const UncheckedLinks& pair : scene.unchecked_links())
    report.unchecked_links.push_back({name(pair.links.first), name(pair.links.second), pair.why});
}

void count_residue(Report& report, const std::vector<Residue>& residue) {
  report.voxels.residue = residue.size();
  std::map<Reason, std::uint64_t> counts;
  for (const Residue& left : residue) ++counts[left.reason];
  report.residue.assign(counts.begin(), counts.end());
}

void replay(Report& report, const std::filesystem::path& trajectory, const Cell& cell, const VoxelGrid& voxels,
            RunLog& log, const Watch& watch) {
  std::ifstream in(trajectory, std::ios::binary);
  const auto note = [&](const ReplayedPieces& replayed) {
    log.now.replayed = replayed;
    log.note_state();
    log.save_if_due();
  };
  const Verdict verdict = verify_trajectory(in, cell, voxels, watch, report.threads, log.now.replayed, note);
  report.verify = {verdict.clean, verdict.collisions, verdict.voxels_checked, verdict.exempt_pairs};
  report.voxels.freed = verdict.freed;
  for (const Finding& finding : verdict.findings)
    report.findings.push_back("line " + std::to_string(finding.line) + ": " + finding.sentence);
}

/// What stood after sweeping, or after as much of it as was done, where it stopped, and what the arm did since.
struct Carved {
  VoxelSet standing;
  Configuration q;
  std::vector<Keyframe> by_arm;
};

Output open_output(const std::filesystem::path& trajectory, TrajectoryForm form, const TrajectoryHeader& header,
                   const Chain& chain, const Report& report, const Checkpoint& at, Carved& carved, const Watch& watch) {
  const std::uint64_t remove = report.voxels.remove;
  if (at.file.bytes == 0) return {trajectory, form, header, chain, remove, report.threads, watch};
  const bool is_needed = !chain.translating() && !at.residue;
  const std::uint64_t by_sweep = at.sweeping ? at.file.keyframes : at.swept ? at.swept->keyframes : 0;
  const auto visit = [&, swept = by_sweep](const Keyframe& keyframe) mutable {
    if (!is_needed) return;
    if (swept == 0) return carved.by_arm.push_back(keyframe);
    --swept;
    carved.q = keyframe.q;
    if (keyframe.cut) carved.standing.erase(keyframe.first, keyframe.last);
  };
  return {trajectory, at.file, header, chain, remove, report.threads, watch, visit};
}

SweepRest sweep(Scene& scene, const VoxelGrid& voxels, const VoxelSet& may_fall, const TrajectoryHeader& header,
                const Helpers& helpers, const Carved& carved, RunLog& log, const Watch& watch) {
  if (log.now.swept) return {carved.standing, log.now.swept->out_of_tool_reach};
  std::optional<SweepStart> start;
  if (log.now.sweeping) start = {*log.now.sweeping, carved.standing, carved.q};
  const SweepListener listener{[&](std::vector<Keyframe> keyframes) { log.output.add(std::move(keyframes)); },
                               [&] { log.go_on(); },
                               [&](const SweepMemory& memory) {
                                 if (log.keeps()) log.now.sweeping = memory;
                                 log.note();
                                 log.save_if_due();
                               }};
  SweepRest left = carve_by_sweeps(scene, voxels, may_fall, header.home, header.seed, helpers, start, listener, watch);
  if (log.keeps()) {
    log.now.sweeping.reset();
    log.now.swept = {log.output.keyframes(), left.out_of_tool_reach};
    log.note();
    log.save_if_due();
  }
  return left;
}

void carve(Scene& scene, const VoxelGrid& voxels, const Octree& octree, const TrajectoryHeader& header,
           const VoxelSet& may_fall, const Helpers& helpers, const Carved& carved, RunLog& log, const Watch& watch) {
  if (scene.chain().translating()) {
    carve_with_gantry(scene, voxels.keep, header.held ? &may_fall : nullptr, header, log, watch);
  } else if (header.search == "sweep") {
    const SweepRest left = sweep(scene, voxels, may_fall, header, helpers, carved, log, watch);
    scene.leave(left.standing);
    const Octree rest = build_octree(left_to_cut(left, voxels.keep), watch);
    carve_with_arm(scene, may_fall, rest, build_block_graph(rest, watch), header.home, header.seed, carved.by_arm, log,
                   watch);
  } else {
    carve_with_arm(scene, may_fall, octree, build_block_graph(octree, watch), header.home, header.seed, carved.by_arm,
                   log, watch);
  }
  log.note();
  log.save_if_due();
}

JobResult plan(const Job& job, const std::filesystem::path& trajectory, const Watch& told, TrajectoryForm form,
               CheckpointFolder kept) {
  const Stopwatch total;
  const Helpers helpers(job.threads);
  Watch watch = told;
  JobResult result;
  Report& report = result.report;
  report.mesh = job.mesh.name;
  report.robot = job.cell.name;
  report.seed = job.seed;
  report.resolution = job.resolution;
  report.threads = job.threads;

  Stopwatch load;
  watch.step(Stage::load, 0, 1);
  check_job(job, watch);
  const Cell cell = parse_cell(job.cell);
  result.grid = cell.grid(job.resolution);
  report.seconds.load = load.seconds();

  Stopwatch voxelizing;
  result.voxels = make_voxels(job, result.grid, watch);
  report.seconds.voxelize = voxelizing.seconds();

  Stopwatch building;
  const Octree octree = build_octree(result.voxels, watch);
  watch.doubts = find_doubts(result.voxels, result.grid);
  count_voxels(report, result.voxels, watch.doubts, octree);
  watch.step(Stage::plan, 0, report.voxels.remove);
  report.seconds.octree = building.seconds();

  Stopwatch planning;
  Scene scene(cell, result.grid, result.voxels.stock);
  const Chain& chain = scene.chain();
  report.search = search_for(job, chain);
  list_unchecked_links(report, scene);
  const TrajectoryHeader header = make_header(job, report.search, cell, chain, result.grid);
  if (const std::string contact = scene.describe_contact(header.home); !contact.empty())
    throw InputError("cell_invalid", "cell '" + cell.name + "': at home " + contact +
                                         ": choose a home clear of the full stock, the room and itself");
  const VoxelSet may_fall = find_unheld(result.voxels);
  Checkpoint now = kept.find_newest().value_or(Checkpoint{});
  Carved carved{result.voxels.stock, header.home, {}};
  Output output = open_output(trajectory, form, header, chain, report, now, carved, watch);
  RunLog log(kept, now, output, scene);
  try {
    if (!now.residue) carve(scene, result.voxels, octree, header, may_fall, helpers, carved, log, watch);
    report.quality.ompl_calls = now.arm.ompl_calls;
    report.quality.ompl_solved = now.arm.ompl_solved;
    report.plan_sha256 = output.finish().sha256;
    count_path(report, output.figures(), result.grid.voxel_m, log.checks());
    if (!now.residue) {
      const bool any_may_fall = chain.translating() && !header.held;
      now.residue = explain_residue(scene, result.voxels, any_may_fall ? result.voxels.stock : may_fall, job.seed,
                                    helpers, watch);
      log.note_state();
      log.save_if_due();
    }
    result.residue = *now.residue;
    count_residue(report, result.residue);
    report.seconds.plan = planning.seconds();

    Stopwatch verifying;
    replay(report, trajectory, cell, result.voxels, log, watch);
    report.seconds.verify = verifying.seconds();
  } catch (const Cancelled&) {
    log.save_at_stop();
    throw;
  }
  report.seconds.total = total.seconds();
  report.peak_memory_bytes = peak_memory_bytes();
  return result;
}

}  // namespace

JobResult run_job(const Job& job, const std::filesystem::path& trajectory, const Watch& watch, TrajectoryForm form) {
  return plan(job, trajectory, watch, form, {});
}

JobResult resume_job(const Job& job, const std::filesystem::path& trajectory, const CheckpointPlace& place,
                     const Watch& watch) {
  return plan(job, trajectory, watch, TrajectoryForm::text, {place.folder, trajectory, job_key(job), place.interval});
}

}  // namespace sculpt
