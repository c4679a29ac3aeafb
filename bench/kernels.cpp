// The inner loops one by one, on the shipped cell and sample: build/release/bin/bench_kernels --benchmark_filter=...
#include <benchmark/benchmark.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/material/block_graph.hpp"
#include "core/material/voxelize.hpp"
#include "core/motion/line.hpp"
#include "core/plan/plan.hpp"

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
