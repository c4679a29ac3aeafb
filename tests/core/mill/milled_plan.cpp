#include "tests/core/mill/milled_plan.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

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

Job make_job(const std::string& mesh, int n, const std::vector<std::string>& tools) {
  Job job;
  job.mesh = {read(SOURCE_DIR "/config/samples/" + mesh + ".stl"), "stl", mesh + ".stl"};
  job.cell = read_cell_files(SOURCE_DIR "/config/cells/studio.json");
  // A block of 50 mm: there is less to be done.
  auto cell = nlohmann::json::parse(job.cell.cell_json);
  cell["stock"]["size_m"] = 0.05;
  cell["stock"]["origin_m"] = {-0.025, -0.025, 0.3};
  job.cell.cell_json = cell.dump();
  job.resolution = n;
  job.search = Search::mill;
  job.mill = MillOrder{read_tool_library(SOURCE_DIR "/config/tools/carving.json", {}), tools};
  return job;
}

}  // namespace sculpt::milled
