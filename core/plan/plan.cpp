#include "core/plan/plan.hpp"

#include <sys/resource.h>

#include <chrono>
#include <fstream>
#include <utility>

#include "core/material/loose_pieces.hpp"
#include "core/material/octree.hpp"
#include "core/motion/block_carve.hpp"
#include "core/motion/gantry.hpp"
#include "core/plan/batch_writer.hpp"
#include "core/plan/path_figures.hpp"
#include "core/search/voxel_search.hpp"
#include "core/sweep/follow.hpp"
#include "core/sweep/sweep.hpp"
#include "core/trajectory/binary.hpp"
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

/// The trajectory file as it grows, and the figures of what was written.
class Output {
 public:
  Output(const std::filesystem::path& path, TrajectoryForm form, const TrajectoryHeader& header, const Chain& chain,
         std::uint64_t remove, int threads, const Watch& watch)
      : path_(path),
        file_(path, std::ios::binary | std::ios::trunc),
        text_(form == TrajectoryForm::text ? file_ : nowhere_, header),
        figures_(chain, header.grid, header.home),
        remove_(remove),
        watch_(watch) {
    if (form == TrajectoryForm::binary) binary_.emplace(file_, header);
    file_.flush();
    check();
    if (threads > 1) beside_.emplace([this](const std::vector<Keyframe>& batch) { write(batch); });
  }

  void add(std::vector<Keyframe> batch) {
    flush();
    for (const Keyframe& keyframe : batch) removed_ += static_cast<std::uint64_t>(run_length(keyframe));
    hand_over(std::move(batch));
    watch_.step(Stage::plan, removed_, remove_);
  }
  void add(const Keyframe& keyframe) {
    removed_ += static_cast<std::uint64_t>(run_length(keyframe));
    waiting_.push_back(keyframe);
    if (waiting_.size() == most_waiting) flush();
    watch_.step(Stage::plan, removed_, remove_);
  }
  /// What was added so far will be in the file soon.
  void flush() {
    if (!waiting_.empty()) hand_over(std::exchange(waiting_, {}));
  }
  TrajectoryEnd finish() {
    flush();
    if (beside_) beside_->finish();
    const TrajectoryEnd end = text_.finish();
    if (binary_) binary_->finish();
    file_.flush();
    check();
    return end;
  }
  /// Once finished.
  const PathFigures& figures() const { return figures_; }

 private:
  static constexpr std::size_t most_waiting = 1024;

  void hand_over(std::vector<Keyframe> batch) {
    if (beside_)
      beside_->add(std::move(batch));
    else
      write(batch);
  }

  void write(const std::vector<Keyframe>& batch) {
    for (const Keyframe& keyframe : batch) {
      text_.add(keyframe);
      if (binary_) binary_->add(keyframe);
      figures_.add(keyframe);
    }
    file_.flush();
    check();
  }

  void check() const {
    if (!file_)
      throw InputError("file_unwritable",
                       "cannot write '" + path_.string() + "': check the folder, its rights and the free space");
  }

  std::filesystem::path path_;
  std::ofstream file_;
  std::ostream nowhere_{nullptr};
  TrajectoryWriter text_;  ///< makes the hash in either form
  std::optional<BinaryWriter> binary_;
  PathFigures figures_;
  std::uint64_t removed_ = 0, remove_;
  const Watch& watch_;
  std::vector<Keyframe> waiting_;
  std::optional<BatchWriter> beside_;  ///< of jobs with more than one thread; last: what it writes to must outlive it
};

void carve_with_gantry(Scene& scene, const VoxelGrid& voxels, const Octree& octree, const BlockGraph& graph,
                       const Configuration& home, const std::string& search, Output& output, const Watch& watch) {
  Gantry gantry(scene, home, translating_entry(octree.n), [&](const Keyframe& keyframe) { output.add(keyframe); });
  const auto follow = [&](const VoxelRun& run) { gantry.follow(run); };
  if (search == "voxel")
    carve_voxelwise(voxels, follow, watch);
  else
    carve_translating(voxels, octree, graph, follow, watch);
  gantry.go_home();
}

void carve_with_arm(Scene& scene, const VoxelSet& may_fall, const Octree& octree, const BlockGraph& graph,
                    const Configuration& home, std::uint64_t seed, Output& output, Report& report, const Watch& watch) {
  Arm arm(scene, may_fall, home, seed, watch.stop, [&](const Keyframe& keyframe) { output.add(keyframe); });
  const auto try_block = [&](int block, int effort) {
    const BlockTrial trial = carve_block(arm, octree.leaves[static_cast<std::size_t>(block)], effort);
    if (trial.removed > 0) output.flush();
    return trial;
  };
  order_blocks(octree, graph, arm.at(), most_effort, try_block, watch);
  arm.go_home();
  report.quality.ompl_calls = arm.ompl_calls();
  report.quality.ompl_solved = arm.ompl_solved();
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
  return header;
}

void count_voxels(Report& report, const VoxelGrid& voxels, const Octree& octree) {
  const auto n = static_cast<std::uint64_t>(voxels.n());
  const std::uint64_t stock = voxels.stock.size();
  report.voxels.total = n * n * n;
  report.voxels.air = report.voxels.total - stock;
  report.voxels.keep = voxels.keep.size();
  report.voxels.remove = stock - report.voxels.keep;
  const VoxelSet loose = find_loose(voxels.keep);
  report.voxels.loose_keep = loose.size();
  report.voxels.loose_keep_pieces = count_pieces(loose);
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

void count_residue(Report& report, const std::vector<Residue>& residue) {
  report.voxels.residue = residue.size();
  std::map<Reason, std::uint64_t> counts;
  for (const Residue& left : residue) ++counts[left.reason];
  report.residue.assign(counts.begin(), counts.end());
}

void replay(Report& report, const std::filesystem::path& trajectory, const Cell& cell, const VoxelGrid& voxels,
            const Watch& watch) {
  std::ifstream in(trajectory, std::ios::binary);
  const Verdict verdict = verify_trajectory(in, cell, voxels, watch, report.threads);
  report.verify = {verdict.clean, verdict.collisions, verdict.voxels_checked};
  report.voxels.freed = verdict.freed;
  for (const Finding& finding : verdict.findings)
    report.findings.push_back("line " + std::to_string(finding.line) + ": " + finding.sentence);
}

}  // namespace

JobResult run_job(const Job& job, const std::filesystem::path& trajectory, const Watch& told, TrajectoryForm form) {
  const Stopwatch total;
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
  count_voxels(report, result.voxels, octree);
  watch.loose_keep = report.voxels.loose_keep;
  watch.step(Stage::plan, 0, report.voxels.remove);
  report.seconds.octree = building.seconds();

  Stopwatch planning;
  Scene scene(cell, result.grid, result.voxels.stock);
  const Chain& chain = scene.chain();
  report.search = search_for(job, chain);
  const TrajectoryHeader header = make_header(job, report.search, cell, chain, result.grid);
  if (const std::string contact = scene.describe_contact(header.home); !contact.empty())
    throw InputError("cell_invalid", "cell '" + cell.name + "': at home " + contact +
                                         ": choose a home clear of the full stock, the room and itself");
  const VoxelSet may_fall = find_unheld(result.voxels);
  Output output(trajectory, form, header, chain, report.voxels.remove, job.threads, watch);
  if (chain.translating()) {
    carve_with_gantry(scene, result.voxels, octree, build_block_graph(octree, watch), header.home, report.search,
                      output, watch);
  } else if (report.search == "sweep") {
    const SweepRest left = carve_by_sweeps(
        scene, result.voxels, may_fall, header.home, job.seed, job.threads,
        [&](std::vector<Keyframe> keyframes) { output.add(std::move(keyframes)); }, watch);
    scene.leave(left.standing);
    const Octree rest = build_octree(left_to_cut(left, result.voxels.keep), watch);
    carve_with_arm(scene, may_fall, rest, build_block_graph(rest, watch), header.home, job.seed, output, report, watch);
  } else {
    carve_with_arm(scene, may_fall, octree, build_block_graph(octree, watch), header.home, job.seed, output, report,
                   watch);
  }
  report.plan_sha256 = output.finish().sha256;
  count_path(report, output.figures(), result.grid.voxel_m, scene.checks());
  result.residue = explain_residue(scene, result.voxels, may_fall, job.seed, job.threads, watch);
  count_residue(report, result.residue);
  report.seconds.plan = planning.seconds();

  Stopwatch verifying;
  replay(report, trajectory, cell, result.voxels, watch);
  report.seconds.verify = verifying.seconds();
  report.seconds.total = total.seconds();
  report.peak_memory_bytes = peak_memory_bytes();
  return result;
}

}  // namespace sculpt
