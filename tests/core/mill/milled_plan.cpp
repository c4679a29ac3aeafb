#include "tests/core/mill/milled_plan.hpp"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/plan/intake.hpp"

namespace sculpt::milled {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

fs::path scratch(const std::string& name) {
  return fs::temp_directory_path() / ("sculpt-mill-" + std::to_string(getpid()) + "-" + name);
}

Job make_job(const std::string& mesh, int n, const std::vector<std::string>& tools, double side_m) {
  Job job;
  job.mesh = {read(SOURCE_DIR "/config/samples/" + mesh + ".stl"), "stl", mesh + ".stl"};
  job.cell = read_cell_files(SOURCE_DIR "/config/cells/studio.json");
  // A small block: there is less to be done.
  auto cell = nlohmann::json::parse(job.cell.cell_json);
  cell["stock"]["size_m"] = side_m;
  cell["stock"]["origin_m"] = {-side_m / 2, -side_m / 2, 0.3};
  job.cell.cell_json = cell.dump();
  job.resolution = n;
  job.search = Search::mill;
  job.mill = MillOrder{read_tool_library(SOURCE_DIR "/config/tools/carving.json", {}), tools};
  return job;
}

Job make_job_of(const std::string& stl, int n, const std::vector<std::string>& tools, double side_m) {
  Job job = make_job("bust", n, tools, side_m);
  job.mesh = {stl, "stl", "part.stl"};
  job.placement.scale_m = 1e-3;
  return job;
}

void change_tool(Job& job, const std::string& name, const std::string& patch) {
  auto library = nlohmann::json::parse(job.mill->library.json);
  for (auto& tool : library["tools"])
    if (tool["name"] == name) tool.merge_patch(nlohmann::json::parse(patch));
  job.mill->library.json = library.dump();
}

Milled mill(Job job) {
  static std::atomic<int> number = 0;
  const fs::path file = scratch(std::to_string(++number) + ".ndjson");
  job.threads = 2;
  Milled milled{std::move(job), {}, {}};
  milled.result = run_job(milled.job, file, {});
  for (const std::string& finding : milled.result.report.findings) std::cout << finding << "\n";
  const Grid grid = parse_cell(milled.job.cell).grid(milled.job.resolution);
  JobShapes shapes(milled.job);
  Mesh part = shapes.place_part(grid, {});
  std::ifstream plan(file, std::ios::binary);
  milled.surface = machined_surface(plan, std::move(part), std::move(shapes).take_voxels(grid, {}), grid, {});
  fs::remove(file);
  return milled;
}

std::vector<double> excess_at(const Milled& milled, const std::function<bool(const Moved&)>& is_meant) {
  const MachinedSurface& surface = milled.surface;
  const Vec3 corner = parse_cell(milled.job.cell).grid(milled.job.resolution).origin_m;
  std::vector<double> found;
  for (std::size_t vertex = 0; vertex < surface.excess_m.size(); ++vertex) {
    const Vec3 at = 1000 * (surface.mesh.vertices[vertex] - corner);
    const Moved moved{at.x(), at.y(), at.z(), 1000 * surface.excess_m[vertex]};
    if (is_meant(moved)) found.push_back(moved.excess);
  }
  std::ranges::sort(found);
  return found;
}

double share_within(const std::vector<double>& excess_mm, double most_mm) {
  return static_cast<double>(std::ranges::upper_bound(excess_mm, most_mm) - excess_mm.begin()) /
         static_cast<double>(excess_mm.size());
}

}  // namespace sculpt::milled
