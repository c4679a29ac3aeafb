// sculpt voxelize: a mesh as the planner sees it, without a server.
#include <unistd.h>

#include <iostream>
#include <memory>

#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cli/files.hpp"
#include "clients/cli/interrupt.hpp"
#include "clients/cli/job_options.hpp"
#include "clients/cli/progress_line.hpp"
#include "clients/cli/report_table.hpp"
#include "core/material/binvox.hpp"
#include "core/material/resolution.hpp"
#include "core/plan/intake.hpp"

namespace sculpt::cli {

namespace {

struct VoxelizeOptions {
  std::string mesh, robot, output;
  int resolution = 0;
  double grid_m = 1;
  bool json = false;
  PlacementOptions placement;
};

int run_voxelize(const VoxelizeOptions& options) {
  Job job;
  job.mesh = read_mesh_file(options.mesh, "mesh");
  job.stock = read_stock(options.placement);
  job.resolution = options.resolution;
  job.placement = to_placement(options.placement);
  job.memory_cap_bytes = options.placement.memory_cap_bytes;
  check_resolution(options.resolution);
  const Grid grid = options.robot.empty() ? Grid{options.resolution, options.grid_m / options.resolution, Vec3::Zero()}
                                          : parse_cell(read_cell(options.robot)).grid(options.resolution);

  std::stop_source stop;
  const Interrupt interrupt([&stop] { stop.request_stop(); });
  ProgressLine progress(STDERR_FILENO, PlainLines::each_second);
  const Watch watch{stop.get_token(), [&](const Progress& at) { progress.tell(name(at.stage), at.done, at.total); }};
  const VoxelGrid voxels = make_voxels(job, grid, watch);
  progress.clear();

  PartFile output(options.output);
  output.stream() << write_binvox(voxels.keep, grid);
  output.finish();
  const auto total = static_cast<std::uint64_t>(grid.n) * grid.n * grid.n;
  const std::uint64_t stock = voxels.stock.size(), keep = voxels.keep.size();
  for (const std::string& line : doubt_lines(find_doubts(voxels, grid))) std::cerr << "sculpt: " << line << "\n";
  if (options.json)
    std::cout << "{\"resolution\":" << grid.n << ",\"voxels\":{\"total\":" << total << ",\"air\":" << total - stock
              << ",\"keep\":" << keep << ",\"remove\":" << stock - keep << ",\"ambiguous\":" << voxels.ambiguous.voxels
              << "}}\n";
  else
    std::cout << options.output << ": " << keep << " voxels to keep, " << stock - keep << " to remove, of " << total
              << "\n";
  return exit_fine;
}

}  // namespace

void add_voxelize(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<VoxelizeOptions>();
  CLI::App& command = add_command(app, invocation, "voxelize", "Turn a mesh into a .binvox file, without a server",
                                  [options] { return run_voxelize(*options); });
  command.add_option("mesh", options->mesh, "The sculpture: .stl .obj .ply .gltf .glb .off .dae")
      ->type_name("MESH")
      ->required();
  command
      .add_option("--resolution", options->resolution, "Voxels along each edge of the grid: a power of two, 8 to 1024")
      ->type_name("N")
      ->required();
  command.add_option("--robot", options->robot, "Take the size and place of the grid from this cell")
      ->type_name("CELL");
  command.add_option("--grid-size", options->grid_m, "Edge of the grid in metres, where no cell says it")
      ->type_name("METRES")
      ->excludes("--robot")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_flag("--json", options->json, "Print the counts as one JSON document");
  command.add_option("-o,--output", options->output, "The .binvox file (target = 1)")->type_name("FILE")->required();
  add_placement_options(command, options->placement);
  add_memory_cap(command, options->placement.memory_cap_bytes);
}

}  // namespace sculpt::cli
