// How long the searches for the translating robot take by themselves, without certificate, writing and replay; prints
// one JSON line a run. Release build only: build/release/bin/bench_search david.stl --resolution 64 128
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "bench/nearest_order.hpp"
#include "core/plan/intake.hpp"
#include "core/plan/plan.hpp"
#include "core/search/voxel_search.hpp"
#include "tests/core/search/replay.hpp"

namespace sculpt {
namespace {

namespace fs = std::filesystem;
using Emit = std::function<void(const VoxelRun&)>;

struct Options {
  fs::path mesh;
  std::vector<int> resolutions{16, 32, 64, 128};
  std::vector<std::string> orders{"voxel", "octree", "nearest"};
  double seconds = 5;
  bool check = false;
};

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Counts what a path is made of, from home and back.
struct PathCount {
  explicit PathCount(int n) : at(translating_entry(n)) {}

  void add(const VoxelRun& run) {
    ++runs;
    if (run.cut) go(run.first);
    removed += run.cut ? static_cast<std::uint64_t>(l1(run.first, run.last)) + 1 : 0;
    go(run.last);
  }

  Voxel at, step;
  std::uint64_t runs = 0, removed = 0, moves = 0, turns = 0;

 private:
  void go(Voxel to) {
    const int length = l1(at, to);
    if (length == 0) return;
    const Voxel way = to - at, next{way.i / length, way.j / length, way.k / length};
    turns += moves > 0 && next != step;
    moves += static_cast<std::uint64_t>(length);
    step = next;
    at = to;
  }
};

/// Peak memory of this process since `reset_peak`, or since its start where the kernel does not let that be reset.
std::uint64_t peak_memory_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (std::uint64_t kib = 0; word == "VmHWM:" && status >> kib) return kib * 1024;
  return 0;
}

void reset_peak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

/// What one order needs to carve.
struct Search {
  const VoxelGrid& voxels;
  std::string order;
  Octree octree;     ///< of order "octree" only
  BlockGraph graph;  ///< of order "octree" only

  void carve(const Emit& emit) const {
    if (order == "voxel")
      carve_voxelwise(voxels, emit, {});
    else if (order == "octree")
      carve_translating(voxels, octree, graph, emit, {});
    else
      carve_nearest(voxels, emit, {});
  }
};

/// Seconds of each repetition: until `least` are spent, 9 times at most.
std::vector<double> time_search(const Search& search, double least) {
  constexpr std::size_t max_times = 9;
  std::vector<double> times;
  double sum = 0;
  do {
    std::uint64_t runs = 0;
    times.push_back(seconds_of([&] { search.carve([&](const VoxelRun&) { ++runs; }); }));
    sum += times.back();
  } while (sum < least && times.size() < max_times);
  std::sort(times.begin(), times.end());
  return times;
}

void check_runs(const Search& search, std::uint64_t reachable) {
  std::vector<VoxelRun> runs;
  search.carve([&](const VoxelRun& run) { runs.push_back(run); });
  const Replayed done = replay(search.voxels, runs);
  const std::string where = "order " + search.order + " at " + std::to_string(search.voxels.n()) + ": ";
  if (!done.fault.empty()) throw std::runtime_error(where + done.fault);
  if (done.cut != reachable)
    throw std::runtime_error(where + "removed " + std::to_string(done.cut) + " of " + std::to_string(reachable) +
                             " voxels that can be reached");
}

void measure(const Options& options, const VoxelGrid& voxels, const std::string& order) {
  reset_peak();
  nlohmann::ordered_json line{{"mesh", options.mesh.filename().string()}, {"resolution", voxels.n()}, {"order", order}};
  Search search{voxels, order, {}, {}};
  if (order == "octree") {
    line["seconds_octree_and_graph"] = seconds_of([&] {
      search.octree = build_octree(voxels, {});
      search.graph = build_block_graph(search.octree, {});
    });
    line["leaves"] = search.octree.leaves.size();
  }
  const std::vector<double> times = time_search(search, options.seconds);
  const std::uint64_t peak = peak_memory_bytes();
  PathCount path(voxels.n());
  search.carve([&](const VoxelRun& run) { path.add(run); });

  const auto ratio = [](double a, std::uint64_t b) { return b ? a / static_cast<double>(b) : 0; };
  const double median = (times[(times.size() - 1) / 2] + times[times.size() / 2]) / 2;
  line["seconds"] = median;
  line["seconds_least"] = times.front();
  line["repetitions"] = times.size();
  line["removed"] = path.removed;
  line["voxels_passed"] = path.moves;
  line["moves_per_voxel"] = ratio(static_cast<double>(path.moves), path.removed);
  line["ns_per_voxel_passed"] = ratio(median * 1e9, path.moves);
  line["turns"] = path.turns;
  line["runs"] = path.runs;
  line["peak_memory_bytes"] = peak;
  if (options.check) {
    check_runs(search, voxels.stock.size() - voxels.keep.size() - enclosed_by_flood(voxels).size());
    line["clean"] = true;
  }
  std::cout << line.dump() << std::endl;
}

void measure_all(const Options& options) {
  Job job;
  std::ifstream file(options.mesh, std::ios::binary);
  job.mesh.bytes = {std::istreambuf_iterator<char>(file), {}};
  const std::string extension = options.mesh.extension().string();
  job.mesh.extension = extension.empty() ? "" : extension.substr(1);
  job.mesh.name = options.mesh.filename().string();
  job.memory_cap_bytes = 8ull << 30;
  const Cell cell = parse_cell(read_cell_files(SOURCE_DIR "/config/cells/gantry.json"));
  for (int resolution : options.resolutions) {
    const VoxelGrid voxels = make_voxels(job, cell.grid(resolution), {});
    for (const std::string& order : options.orders) measure(options, voxels, order);
  }
}

int run(int argc, char** argv) {
  CLI::App app{
      "Seconds of the searches for the translating robot, alone. Prints one JSON line a run; voxels_passed is every "
      "step "
      "from voxel to voxel, from home and back.\nExit codes: 0 fine, 1 a run was not clean or the mesh cannot be "
      "carved, "
      "2 usage."};
  Options options;
  app.add_option("MESH", options.mesh, "The target")->required()->check(CLI::ExistingFile);
  app.add_option("-r,--resolution", options.resolutions, "Voxels an edge")
      ->check(CLI::IsMember({8, 16, 32, 64, 128, 256, 512}))
      ->capture_default_str();
  app.add_option("-o,--order", options.orders, "voxel, octree and nearest: the planners, and plain nearest neighbour")
      ->check(CLI::IsMember({"voxel", "octree", "nearest"}))
      ->capture_default_str();
  app.add_option("--seconds", options.seconds, "A search is repeated until it took so long, 9 times at most")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_flag("--check", options.check, "Replay every run too, voxel by voxel");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    measure_all(options);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "bench_search: " << error.what() << '\n';
    return 1;
  }
}

}  // namespace
}  // namespace sculpt

int main(int argc, char** argv) {
  return sculpt::run(argc, argv);
}
