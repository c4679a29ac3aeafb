#include "clients/cli/job_options.hpp"

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include "clients/cli/exit_code.hpp"
#include "clients/cli/files.hpp"
#include "core/base/extension.hpp"
#include "core/cell/shipped_cells.hpp"
#include "core/material/resolution.hpp"

namespace sculpt::cli {

namespace fs = std::filesystem;

namespace {

/// CLI11 reads -1 as the largest unsigned number.
const CLI::Validator not_negative{
    [](std::string& text) { return text.starts_with('-') ? text + " is negative: give 0 or more" : std::string(); },
    ""};

/// Nor does it say when a number is too large.
const CLI::Validator seed_number{[](std::string& text) {
                                   std::uint64_t seed = 0;
                                   const auto read = std::from_chars(text.data(), text.data() + text.size(), seed);
                                   const bool whole = read.ec == std::errc() && read.ptr == text.data() + text.size();
                                   return whole ? std::string() : text + " is no whole number from 0 to 2^64 - 1";
                                 },
                                 ""};

Vec3 vec3(const std::vector<double>& values) {
  return {values[0], values[1], values[2]};
}

}  // namespace

void add_placement_options(CLI::App& command, PlacementOptions& options) {
  const char* group = "Placement and stock";
  command
      .add_option("--scale", options.scale_m,
                  "Metres per unit of the mesh file; without it the mesh is made to fit the stock")
      ->type_name("METRES")
      ->group(group);
  command.add_option("--rotate", options.rotate_deg, "Turn about the fixed x, y, z axes, in degrees, before scaling")
      ->type_name("R,P,Y")
      ->delimiter(',')
      ->expected(3)
      ->group(group);
  command.add_option("--offset", options.offset_m, "Shift in metres, after centring and standing on the floor")
      ->type_name("X,Y,Z")
      ->delimiter(',')
      ->expected(3)
      ->group(group);
  command
      .add_option("--margin", options.margin_m, "Left free at each side and at the top when the mesh is made to fit")
      ->type_name("METRES")
      ->group(group);
  command
      .add_option("--stock-box", options.stock_box_m,
                  "The stock is this box (metres from the grid's corner), not the whole grid")
      ->type_name("X0,Y0,Z0,X1,Y1,Z1")
      ->delimiter(',')
      ->expected(6)
      ->group(group);
  command
      .add_option("--stock", options.stock_file,
                  "The stock is this mesh (metres from the grid's corner) or .binvox, not the whole grid")
      ->type_name("FILE")
      ->excludes("--stock-box")
      ->group(group);
}

void add_memory_cap(CLI::App& command, std::uint64_t& bytes) {
  command.add_option("--memory-cap", bytes, "Refuse what is predicted to need more, e.g. 512M or 8G")
      ->transform(CLI::AsSizeValue(false))
      ->transform(not_negative)
      ->type_name("BYTES")
      ->default_str("2G");
}

void add_job_options(CLI::App& command, JobOptions& options) {
  command.add_option("mesh", options.mesh, "The sculpture: .stl .obj .ply .gltf .glb .off .dae, or a .binvox")
      ->type_name("MESH")
      ->required();
  command
      .add_option("--resolution", options.resolution, "Voxels along each edge of the grid: a power of two, 8 to 1024")
      ->type_name("N")
      ->required();
  command.add_option("--robot", options.robot, "The cell: a name under config/cells, or the path of a cell file")
      ->type_name("CELL")
      ->required();
  command.add_option("--search", options.search, "The planner, e.g. octree; without it the default")->type_name("NAME");
  command.add_option("--seed", options.seed, "Same job and same seed: same plan, byte for byte")
      ->type_name("K")
      ->check(seed_number)
      ->capture_default_str();
  command.add_flag("--allow-freed", options.allow_freed,
                   "Let pieces come loose while a translating robot carves; arms never do");
  const char* group = "Milling tools";
  MillOptions& mill = options.mill;
  command
      .add_option("--tools", mill.tools, "Carve with these tools of the library, in this order; search is then 'mill'")
      ->type_name("NAME,...")
      ->delimiter(',')
      ->group(group);
  command
      .add_option("--tool-library", mill.library, "Where they are: a name under config/tools, or the path of a file")
      ->type_name("LIBRARY")
      ->capture_default_str()
      ->group(group);
  command.add_option("--tolerance", mill.tolerance_m, "What may stand above the surface where these tools come to it")
      ->type_name("METRES")
      ->capture_default_str()
      ->group(group);
  command.add_option("--scallop", mill.scallop_m, "Of that, between rows; default 0.35 of it")
      ->type_name("METRES")
      ->group(group);
  command.add_option("--allowance", mill.allowance_m, "Of that, left on purpose; default 0.1 of it")
      ->type_name("METRES")
      ->group(group);
  add_placement_options(command, options.placement);
}

Placement to_placement(const PlacementOptions& options) {
  Placement placement;
  placement.scale_m = options.scale_m;
  placement.rotation_rad = vec3(options.rotate_deg) * (std::numbers::pi / 180);
  placement.offset_m = vec3(options.offset_m);
  placement.margin_m = options.margin_m;
  return placement;
}

MeshFile read_mesh_file(const std::string& path, const std::string& what) {
  return {read_input(path, what), extension_of(path), fs::path(path).filename().string()};
}

Stock read_stock(const PlacementOptions& options) {
  Stock stock;
  if (const auto& box = options.stock_box_m; !box.empty())
    stock.box = Stock::Box{{box[0], box[1], box[2]}, {box[3], box[4], box[5]}};
  if (!options.stock_file.empty()) stock.mesh = read_mesh_file(options.stock_file, "stock");
  return stock;
}

bool is_cell_path(const std::string& robot) {
  return robot.find('/') != std::string::npos || robot.ends_with(".json");
}

CellFiles read_cell(const std::string& robot) {
  if (is_cell_path(robot)) {
    read_input(robot, "cell");
    return read_cell_files(robot);
  }
  return read_cell_files(find_cell(robot, shipped_cell_folders()));
}

std::optional<MillOrder> read_mill_order(const MillOptions& options) {
  if (options.tools.empty()) return std::nullopt;
  return MillOrder{read_tool_library(options.library, shipped_tool_folders()), options.tools, options.tolerance_m,
                   options.scallop_m, options.allowance_m};
}

Job read_job(const JobOptions& options) {
  Job job;
  job.mesh = read_mesh_file(options.mesh, "mesh");
  job.stock = read_stock(options.placement);
  job.cell = read_cell(options.robot);
  job.resolution = options.resolution;
  job.mill = read_mill_order(options.mill);
  if (job.mill) job.search = Search::mill;
  if (!options.search.empty()) job.search = parse_search(options.search);
  job.seed = options.seed;
  job.allow_freed = options.allow_freed;
  job.placement = to_placement(options.placement);
  job.memory_cap_bytes = options.placement.memory_cap_bytes;
  return job;
}

}  // namespace sculpt::cli
