// The inner loops one by one, on the shipped cell and sample: build/release/bin/bench_kernels --benchmark_filter=...
#include <benchmark/benchmark.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/material/block_graph.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/motion/line.hpp"
#include "core/motion/transit.hpp"
#include "core/plan/intake.hpp"
#include "core/plan/plan.hpp"
#include "core/solid/voxelize.hpp"
#include "core/sweep/columns.hpp"
#include "core/sweep/field/posture_lanes.hpp"
#include "core/sweep/follow.hpp"

namespace sculpt {
namespace {

const std::filesystem::path config = SOURCE_DIR "/config";

std::string read(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Job sample_job(const char* cell, int n) {
  Job job;
  job.cell = read_cell_files(config / "cells" / (std::string(cell) + ".json"));
  job.mesh = {read(config / "samples/bust.stl"), "stl", "bust.stl"};
  job.resolution = n;
  return job;
}

/// The Panda with its tool standing in the middle of an empty grid, and a configuration one voxel beside it.
struct Standing {
  Cell cell = parse_cell(read_cell_files(config / "cells/panda-turntable.json"));
  Grid grid = cell.grid(64);
  Scene scene{cell, grid, VoxelSet(64)};
  Configuration here =
      solve_rounded(scene.chain(), {grid.centre({32, 32, 32}), Vec3::UnitZ()}, cell.home(scene.chain())).value();
  IkGoal beside{grid.centre({33, 32, 32}), Vec3::UnitZ()};
  Configuration there = solve_rounded(scene.chain(), beside, here).value();
};

void forward_kinematics_of_the_tool(benchmark::State& state) {
  const Standing s;
  for (auto _ : state) benchmark::DoNotOptimize(s.scene.chain().tool_pose(s.here));
}
BENCHMARK(forward_kinematics_of_the_tool);

void ik_to_the_next_voxel(benchmark::State& state) {
  const Standing s;
  for (auto _ : state) benchmark::DoNotOptimize(solve_ik(s.scene.chain(), s.beside, s.here));
}
BENCHMARK(ik_to_the_next_voxel);

void contacts_of_a_configuration(benchmark::State& state) {
  const Standing s;
  for (auto _ : state) benchmark::DoNotOptimize(s.scene.contact_at(s.here));
}
BENCHMARK(contacts_of_a_configuration);

void certificate_of_an_edge_of_one_voxel(benchmark::State& state) {
  const Standing s;
  for (auto _ : state) benchmark::DoNotOptimize(s.scene.certify(s.here, s.there));
}
BENCHMARK(certificate_of_an_edge_of_one_voxel);

void tool_against_material(benchmark::State& state) {
  const Standing s;
  VoxelSet walls(64, true);
  for (int k = 32; k < 64; ++k) walls.erase({32, 32, k});
  const Scene scene(s.cell, s.grid, walls);
  const ToolPose pose{s.grid.centre({32, 32, 32}), Vec3::UnitZ()};
  for (auto _ : state) benchmark::DoNotOptimize(scene.tool_fits(pose, {}));
}
BENCHMARK(tool_against_material);

/// The Panda above the full stock that the bust is carved from, coming down on it.
struct Sweeping {
  explicit Sweeping(int resolution)
      : n(resolution),
        job(sample_job("panda-turntable", n)),
        cell(parse_cell(job.cell)),
        grid(cell.grid(n)),
        voxels(make_voxels(job, grid, {})),
        scene(cell, grid, voxels.stock),
        view(tool_views(n)[0]) {}

  Vec3 hub() const { return {n / 2.0, n / 2.0, n + 1.0}; }
  Configuration start() const {
    return solve_ik(scene.chain(), {view.ball_m(grid, hub()), view.axis()}, cell.home(scene.chain())).value();
  }
  PostureField field() const { return {scene, view, PostureLattice::Start{start()}, Helpers(1), {}}; }

  int n;
  Job job;
  Cell cell;
  Grid grid;
  VoxelGrid voxels;
  Scene scene;
  ToolView view;
};

/// Guesses are off by what interpolating in a field leaves, about 1e-4 rad.
void postures_beside_each_other(benchmark::State& state) {
  const Sweeping s(64);
  const PostureLanes lanes(s.scene.chain(), s.view.axis());
  const Configuration here = s.start();
  PostureBatch guesses;
  for (int lane = 0; lane < lane_count; ++lane)
    guesses.set(lane, s.view.ball_m(s.grid, s.hub() + 0.1 * lane * Vec3::UnitX()), here);
  for (auto _ : state) {
    PostureBatch batch = guesses;
    lanes.solve(batch);
    benchmark::DoNotOptimize(batch);
  }
  state.SetItemsProcessed(state.iterations() * lane_count);
}
BENCHMARK(postures_beside_each_other);

void derivatives_of_edges_from_postures(benchmark::State& state) {
  const Sweeping s(64);
  const PostureLanes lanes(s.scene.chain(), s.view.axis());
  const Configuration here = s.start();
  EdgeBatch edges;
  for (int lane = 0; lane < lane_count; ++lane) {
    edges.from.set(lane, here);
    edges.to.set(lane, here + Configuration::Constant(here.size(), 0.001 * lane));
  }
  for (auto _ : state) {
    lanes.derive(edges);
    benchmark::DoNotOptimize(edges);
  }
  state.SetItemsProcessed(state.iterations() * lane_count);
}
BENCHMARK(derivatives_of_edges_from_postures);

void posture_of_the_field(benchmark::State& state) {
  const Sweeping s(64);
  const PostureField field = s.field();
  const Vec3 between = s.hub() - Vec3(3.3, 2.2, 20.1);
  for (auto _ : state) benchmark::DoNotOptimize(field.at(between));
}
BENCHMARK(posture_of_the_field);

void posture_field_from_above(benchmark::State& state) {
  const Sweeping s(64);
  const Configuration start = s.start();
  for (auto _ : state) benchmark::DoNotOptimize(PostureField(s.scene, s.view, {start}, 1, {}));
}
BENCHMARK(posture_field_from_above)->Unit(benchmark::kMillisecond);

JointBox box_around(const Configuration& q) {
  const Configuration half = Configuration::Constant(q.size(), 0.03);  // about what the joints do in a cell of a field
  return {q - half, q + half};
}

void bubble_around_a_configuration(benchmark::State& state) {
  const Sweeping s(64);
  const Configuration here = s.start();
  for (auto _ : state) {
    Scene::Pairs pairs = s.scene.pairs();
    benchmark::DoNotOptimize(s.scene.bubble(here, box_around(here), {}, s.scene.full_stock(), pairs));
  }
}
BENCHMARK(bubble_around_a_configuration)->Unit(benchmark::kMicrosecond);

void bubble_holds_a_configuration(benchmark::State& state) {
  const Sweeping s(64);
  const Configuration here = s.start();
  const JointBox box = box_around(here);
  Scene::Pairs pairs = s.scene.pairs();
  const Bubble bubble = s.scene.bubble(here, box, {}, s.scene.full_stock(), pairs);
  const Configuration inside = here + 0.3 * (box.high - here);
  if (!bubble.holds(inside)) return state.SkipWithError("there is no bubble here");
  for (auto _ : state) benchmark::DoNotOptimize(bubble.holds(inside));
}
BENCHMARK(bubble_holds_a_configuration);

void transit_from_home_to_above_the_stock(benchmark::State& state) {
  const Sweeping s(64);
  const Configuration home = s.cell.home(s.scene.chain()), start = s.start();
  for (auto _ : state) {
    const Transit transit = plan_transit(s.scene, home, start, 1, {});
    if (transit.path.empty()) return state.SkipWithError("there is no transit");
    benchmark::DoNotOptimize(transit);
  }
}
BENCHMARK(transit_from_home_to_above_the_stock)->Unit(benchmark::kMicrosecond);

ReachRows reach_of(const PostureField& field) {
  return {field.view().n, [&](const Vec3& cell) { return field.part(cell); },
          [&](Voxel part) { return field.usable_part(part); }};
}

void sweep_along_a_direction(benchmark::State& state) {
  const Sweeping s(static_cast<int>(state.range(0)));
  const PostureField field = s.field();
  const ReachRows reach = reach_of(field);
  const Columns columns(s.view, s.voxels.stock, s.voxels.keep, reach);
  for (auto _ : state) benchmark::DoNotOptimize(columns.count_cuttable());
  state.SetItemsProcessed(state.iterations() * s.n * s.n * s.n);
}
BENCHMARK(sweep_along_a_direction)->Arg(64)->Arg(256)->Unit(benchmark::kMillisecond);

/// The columns with all above the middle layer cut.
Columns columns_down_to_the_middle(const Sweeping& s, const ReachRows& reach, double tolerance, Vec3& at) {
  Columns columns(s.view, s.voxels.stock, s.voxels.keep, reach);
  for (int layer = s.n - 1; layer > s.n / 2; --layer) columns.cut_layer(layer, at, tolerance);
  return columns;
}

void strokes_of_the_middle_layer(benchmark::State& state) {
  const Sweeping s(static_cast<int>(state.range(0)));
  const PostureField field = s.field();
  const ReachRows reach = reach_of(field);
  const double tolerance = path_tolerance(s.scene.tool(), s.grid.voxel_m).ball;
  Vec3 above = s.hub();
  const Columns columns = columns_down_to_the_middle(s, reach, tolerance, above);
  std::int64_t strokes = 0;
  for (auto _ : state) {
    state.PauseTiming();
    Columns fresh = columns;
    Vec3 at = above;
    state.ResumeTiming();
    strokes += static_cast<std::int64_t>(fresh.cut_layer(s.n / 2, at, tolerance).size());
  }
  state.SetItemsProcessed(strokes);
}
BENCHMARK(strokes_of_the_middle_layer)->Arg(64)->Arg(256)->Unit(benchmark::kMicrosecond);

void keyframes_of_the_middle_layer(benchmark::State& state) {
  const Sweeping s(static_cast<int>(state.range(0)));
  const PostureField field = s.field();
  const ReachRows reach = reach_of(field);
  const double tolerance = path_tolerance(s.scene.tool(), s.grid.voxel_m).ball;
  Vec3 above = s.hub();
  Columns columns = columns_down_to_the_middle(s, reach, tolerance, above);
  Vec3 at = above;
  const std::vector<Stroke> strokes = columns.cut_layer(s.n / 2, at, tolerance);
  std::int64_t keyframes = 0;
  for (auto _ : state) {
    const FollowedStrokes followed = follow(field, s.scene.tool(), s.grid, above, strokes);
    if (followed.strokes == 0) return state.SkipWithError("no stroke could be followed");
    keyframes += static_cast<std::int64_t>(followed.keyframes.size());
  }
  state.SetItemsProcessed(keyframes);
}
BENCHMARK(keyframes_of_the_middle_layer)->Arg(64)->Arg(256)->Unit(benchmark::kMillisecond);

void voxelize_the_bust(benchmark::State& state) {
  const Job job = sample_job("gantry", static_cast<int>(state.range(0)));
  const Grid grid = parse_cell(job.cell).grid(job.resolution);
  const Mesh mesh = place_mesh(load_mesh(job.mesh.bytes, "stl", job.memory_cap_bytes, {}), {}, grid);
  for (auto _ : state) benchmark::DoNotOptimize(voxelize(mesh, grid, {}));
}
BENCHMARK(voxelize_the_bust)->RangeMultiplier(4)->Range(16, 256)->Unit(benchmark::kMillisecond);

void octree_and_graph_of_the_bust(benchmark::State& state) {
  const Job job = sample_job("gantry", static_cast<int>(state.range(0)));
  const VoxelGrid voxels = make_voxels(job, parse_cell(job.cell).grid(job.resolution), {});
  for (auto _ : state) benchmark::DoNotOptimize(build_block_graph(build_octree(voxels, {}), {}));
}
BENCHMARK(octree_and_graph_of_the_bust)->RangeMultiplier(4)->Range(16, 256)->Unit(benchmark::kMillisecond);

void plan_and_verify_the_bust(benchmark::State& state, const char* cell) {
  const Job job = sample_job(cell, static_cast<int>(state.range(0)));
  const auto file = std::filesystem::temp_directory_path() / "sculpt-bench.ndjson";
  double plan = 0, verify = 0;
  for (auto _ : state) {
    const Report report = run_job(job, file, {}).report;
    if (!report.verify.clean) state.SkipWithError("the replay found a collision");
    plan += report.seconds.plan;
    verify += report.seconds.verify;
  }
  std::filesystem::remove(file);
  state.counters["plan_s"] = benchmark::Counter(plan, benchmark::Counter::kAvgIterations);
  state.counters["verify_s"] = benchmark::Counter(verify, benchmark::Counter::kAvgIterations);
}
BENCHMARK_CAPTURE(plan_and_verify_the_bust, gantry, "gantry")->Arg(16)->Arg(64)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan_and_verify_the_bust, panda_turntable, "panda-turntable")
    ->Arg(16)
    ->Arg(32)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sculpt
