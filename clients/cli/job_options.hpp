// The options that describe a job, shared by submit, plan, voxelize and verify FILE.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/plan/plan.hpp"

namespace sculpt::cli {

/// As given on the command line: lengths in metres, angles in degrees.
struct PlacementOptions {
  std::optional<double> scale_m;
  std::vector<double> rotate_deg{0, 0, 0};
  std::vector<double> offset_m{0, 0, 0};
  double margin_m = 0;
  std::vector<double> stock_box_m;  ///< empty or x0,y0,z0,x1,y1,z1
  std::string stock_file;
  std::uint64_t memory_cap_bytes = 2ull << 30;
};

/// For milling tools.
struct MillOptions {
  std::vector<std::string> tools;
  std::string library = "carving";
  double tolerance_m = MillOrder{}.tolerance_m;
  std::optional<double> scallop_m, allowance_m;
};

struct JobOptions {
  std::string mesh, robot;
  int resolution = 0;
  std::string search;  ///< empty: the default of whoever plans
  std::uint64_t seed = 0;
  bool allow_freed = false;
  MillOptions mill;
  PlacementOptions placement;
};

void add_placement_options(CLI::App& command, PlacementOptions& options);
/// For what is planned in this process: a server has its own cap.
void add_memory_cap(CLI::App& command, std::uint64_t& bytes);
/// MESH, --resolution, --robot, --search, --seed, --allow-freed, milling tools and the placement.
void add_job_options(CLI::App& command, JobOptions& options);

Placement to_placement(const PlacementOptions& options);

/// A file's bytes with its kind. Throws Failure (usage) where it cannot be read.
MeshFile read_mesh_file(const std::string& path, const std::string& what);
/// Reads the tool library; nothing where no tools are named.
std::optional<MillOrder> read_mill_order(const MillOptions& options);
/// Reads the stock file, if one is named.
Stock read_stock(const PlacementOptions& options);

/// True for what is looked for on this disk: anything with a '/' or ending in .json.
bool is_cell_path(const std::string& robot);
/// The cell's files: a path, or a name under the shipped cells. Throws Failure or InputError.
CellFiles read_cell(const std::string& robot);

/// Everything read from disk, ready for the planner.
Job read_job(const JobOptions& options);

}  // namespace sculpt::cli
