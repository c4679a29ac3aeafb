// sculpt place: where table or base should stand for most of a target to be reached, without a server.
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>
#include <thread>

#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cli/files.hpp"
#include "clients/cli/interrupt.hpp"
#include "clients/cli/job_options.hpp"
#include "clients/cli/place/place_map.hpp"
#include "clients/cli/place/place_table.hpp"
#include "clients/cli/progress_line.hpp"
#include "core/base/extension.hpp"
#include "core/cell/shipped_cells.hpp"
#include "core/place/certify_stand.hpp"
#include "core/place/placed_cell.hpp"
#include "core/place/stand_study.hpp"
#include "core/plan/intake.hpp"

namespace sculpt::cli {

namespace {

constexpr double farthest = 1e4;      // of what is given in m or degrees
constexpr int study_resolution = 32;  // of the voxels that a study counts

struct PlaceOptions {
  JobOptions job;
  std::string moved = "table", joint;
  std::string x, y, z, turn, height, stickout;
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  int rows = 10, certified = 3;
  bool turn_over = false, json = false;
  std::string output, map;
};

/// FROM:TO:STEPS, or one value.
StandRange read_range(const std::string& option, const std::string& text, double unit) {
  std::vector<double> values;
  const char* at = text.data();
  const char* end = text.data() + text.size();
  while (at < end && values.size() < 4) {
    double value = 0;
    const auto read = std::from_chars(at, end, value);
    if (read.ec != std::errc() || !(std::abs(value) <= farthest)) break;
    values.push_back(value);
    at = read.ptr;
    if (at < end && *at == ':' && at + 1 < end)
      ++at;
    else
      break;
  }
  const bool whole = at == end && (values.size() == 1 || values.size() == 3);
  if (!whole ||
      (values.size() == 3 && !(values[2] >= 1 && values[2] <= 1000 && values[2] == static_cast<int>(values[2]))))
    throw Failure(exit_usage, "usage",
                  option + " " + text + " is no range: give FROM:TO:STEPS, 1 to 1000 steps, or one value");
  if (values.size() == 1) return {values[0] * unit, values[0] * unit, 1};
  return {values[0] * unit, values[1] * unit, static_cast<int>(values[2])};
}

StandRanges read_ranges(const PlaceOptions& options, const Cell& cell, int joint) {
  StandRanges ranges = ranges_around(cell, joint);
  const auto read = [](const char* option, const std::string& text, StandRange& range, double unit) {
    if (!text.empty()) range = read_range(option, text, unit);
  };
  read("--x", options.x, ranges.x, 1);
  read("--y", options.y, ranges.y, 1);
  read("--z", options.z, ranges.z, 1);
  read("--turn", options.turn, ranges.turn, std::numbers::pi / 180);
  read("--height", options.height, ranges.height, 1);
  read("--stickout", options.stickout, ranges.stickout, 1);
  if (std::ranges::min(ranges.stickout.values()) < 0)
    throw Failure(exit_usage, "usage", "--stickout " + options.stickout + ": no tool sticks out by less than nothing");
  return ranges;
}

/// What the stock takes up of the grid, of 1 along each edge.
Eigen::AlignedBox3d stock_box(const VoxelGrid& voxels) {
  Eigen::AlignedBox3d box;
  for_each_voxel(voxels.stock, [&](Voxel v) {
    box.extend(Vec3(v.i, v.j, v.k));
    box.extend(Vec3(v.i + 1, v.j + 1, v.k + 1));
  });
  return {box.min() / voxels.n(), box.max() / voxels.n()};
}

/// The cell's files with their place.
CellSource read_source(const std::string& robot) {
  CellSource source{read_cell(robot), robot, {}};
  if (!is_cell_path(robot)) source.path = find_cell(robot, shipped_cell_folders());
  source.cell = parse_cell(source.files);
  return source;
}

/// The cell at this stand, with a home that is free there if its own is not and one is known.
Cell cell_to_write(const Cell& cell, int joint, const RatedStand& rated) {
  Cell moved = cell_at(cell, joint, rated.stand);
  if (rated.reach.home_is_free || !rated.reach.above) return moved;
  const Chain chain = moved.chain();
  moved.rest = chain.joint_values(*rated.reach.above);
  return moved;
}

std::optional<Configuration> new_home(const RatedStand& rated) {
  if (rated.reach.home_is_free) return std::nullopt;
  return rated.reach.above;
}

/// The best of those that were certified: by what is certified, then in the order of the estimate.
std::size_t best_of(const std::vector<RatedStand>& rated, const std::vector<CertifiedShare>& certified) {
  std::size_t best = 0;
  for (std::size_t at = 0; at < std::min(rated.size(), certified.size()); ++at)
    if (certified[at].home_contact.empty() &&
        (!certified[best].home_contact.empty() || certified[at].held > certified[best].held))
      best = at;
  return best;
}

void write_cell(const CellSource& source, int joint, const RatedStand& rated, const std::string& output) {
  const PlacedCell placed = place_cell(source, joint, rated.stand, new_home(rated), output);
  PartFile urdf(std::filesystem::path(output).parent_path() / placed.urdf_name), cell(output);
  urdf.stream() << placed.urdf;
  cell.stream() << placed.cell_json;
  urdf.finish();
  cell.finish();
}

/// What was written, and what to do where its home cannot be used.
void tell_written(const RatedStand& rated, const std::string& home_contact, std::size_t rank,
                  const PlaceOptions& options) {
  if (!options.json) std::cout << "\n" << options.output << ": rank " << rank + 1 << "\n";
  if (!home_contact.empty() || (!rated.reach.home_is_free && !rated.reach.above))
    std::cerr << "sculpt: warning: at the home of " << options.output << " "
              << (home_contact.empty() ? "something touches" : home_contact)
              << ": give it another home before you plan with it\n";
  else if (!rated.reach.home_is_free)
    std::cerr << "sculpt: note: the cell's home touches something there, so " << options.output
              << " has another: over the block, the tool upright\n";
}

void check_output(const PlaceOptions& options, const CellSource& source) {
  if (options.output.empty()) return;
  if (extension_of(options.output) != "json")
    throw Failure(exit_usage, "format_unknown", "a cell file's name ends in .json, " + options.output + " does not");
  const auto urdf = std::filesystem::path(options.output).replace_extension(".urdf");
  const auto refuse_if = [&](const std::filesystem::path& own) {
    std::error_code none;
    for (const std::filesystem::path& file : {std::filesystem::path(options.output), urdf})
      if (std::filesystem::equivalent(file, own, none))
        throw Failure(exit_usage, "usage", file.string() + " is a file of the cell that is studied: name another one");
  };
  refuse_if(source.path);
  for (const auto& [name, bytes] : source.files.files) refuse_if(source.path.parent_path() / name);
}

int run_place(const PlaceOptions& options) {
  Job job;
  job.mesh = read_mesh_file(options.job.mesh, "mesh");
  job.stock = read_stock(options.job.placement);
  job.resolution = study_resolution;
  job.placement = to_placement(options.job.placement);
  job.memory_cap_bytes = options.job.placement.memory_cap_bytes;
  const CellSource source = read_source(options.job.robot);
  const Cell& cell = source.cell;
  check_output(options, source);
  const int joint = options.joint.empty() ? find_moved_joint(cell, options.moved == "base" ? Moved::base : Moved::table)
                                          : find_moved_joint(cell, options.joint);
  const Stand own = stand_of(cell, joint);
  const std::vector<Stand> stands = list_stands(read_ranges(options, cell, joint), own);

  std::stop_source stop;
  const Interrupt interrupt([&stop] { stop.request_stop(); });
  ProgressLine progress(STDERR_FILENO, PlainLines::each_second);
  const Watch watch{stop.get_token(), [&](const Progress& at) { progress.tell(name(at.stage), at.done, at.total); }};
  const Helpers helpers(options.threads);
  const RunContext run{options.job.seed, helpers, watch};
  const VoxelGrid voxels = make_voxels(job, cell.grid(study_resolution), watch);
  std::vector<double> stickouts;
  stickouts.reserve(stands.size());
  for (const Stand& stand : stands) stickouts.push_back(stand.stickout_m);
  const Access access = access_of(cell.chain());
  const ReachStudy study(cell, joint, stock_box(voxels), study_resolution, stickouts);
  const std::vector<RatedStand> rated =
      rate_stands(study, find_demand(voxels, {no_turn}, access, run), stands, own, run);
  std::vector<CertifiedShare> certified;
  const int to_certify = access == Access::any_way ? 0 : options.certified;  // translating robots plan without fields
  for (int at = 0; at < std::min<int>(to_certify, static_cast<int>(rated.size())); ++at) {
    watch.step(Stage::verify, static_cast<std::uint64_t>(at), static_cast<std::uint64_t>(to_certify));
    certified.push_back(certify_stand(cell_to_write(cell, joint, rated[static_cast<std::size_t>(at)]), voxels, run));
  }
  const std::size_t best = best_of(rated, certified);
  std::vector<TurnOver> turn_overs;
  if (options.turn_over) turn_overs = rate_turn_overs(voxels, access, rated[best].reach, run);
  progress.clear();

  const PlaceReport report{cell, joint, own, rated, certified, best, turn_overs};
  std::cout << (options.json ? place_json(report) + "\n" : place_table(report, options.rows));
  if (!options.map.empty()) {
    PartFile map(options.map);
    map.stream() << place_map_svg(report);
    map.finish();
  }
  if (!options.output.empty()) {
    write_cell(source, joint, rated[best], options.output);
    tell_written(rated[best], best < certified.size() ? certified[best].home_contact : "", best, options);
  }
  return exit_fine;
}

}  // namespace

void add_place(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<PlaceOptions>();
  CLI::App& command = add_command(app, invocation, "place", "Find where table or base should stand, without a server",
                                  [options] { return run_place(*options); });
  command
      .add_option("mesh", options->job.mesh, "The sculpture: .stl .obj .ply .gltf .glb .off .dae, or a .binvox of 32^3")
      ->type_name("MESH")
      ->required();
  command.add_option("--robot", options->job.robot, "The cell: a name under config/cells, or the path of a cell file")
      ->type_name("CELL")
      ->required();
  command.add_option("--move", options->moved, "What is moved: table or base")
      ->type_name("WHAT")
      ->check(CLI::IsMember({"table", "base"}))
      ->capture_default_str();
  command.add_option("--joint", options->joint, "Move what hangs below this joint of the URDF instead")
      ->type_name("NAME")
      ->excludes("--move");
  const auto range = [&](const char* option, std::string& text, const char* what) {
    command.add_option(option, text, what)->type_name("FROM:TO:STEPS")->group("Stands");
  };
  range("--x", options->x, "Metres: x of the moved joint's origin in its parent link");
  range("--y", options->y, "Metres: y of it");
  range("--z", options->z, "Metres: z of it");
  range("--turn", options->turn, "Degrees about the parent link's z, beside how it is turned in the URDF");
  range("--height", options->height, "Metres, of the block's floor over the stock's link");
  range("--stickout", options->stickout, "Metres, of the tool");
  command.add_option("--rows", options->rows, "Stands in the table; the cell's own is always in it")
      ->type_name("N")
      ->capture_default_str();
  command.add_option("--certify", options->certified, "So many of the best are certified by the fields of sweeps")
      ->type_name("N")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command.add_flag("--turn-over", options->turn_over,
                   "Say what a second clamping with the mesh turned over would add at the best stand");
  command.add_option("--map", options->map, "Draw maps of all stands over x and y")->type_name("FILE.svg");
  command.add_option("-o,--output", options->output, "Write the best as a cell file, with its URDF beside it")
      ->type_name("CELL.json");
  command.add_option("--threads", options->threads, "Worker threads; the answer is the same at any number")
      ->type_name("T")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command.add_flag("--json", options->json, "Print all stands as one JSON document");
  add_placement_options(command, options->job.placement);
  add_memory_cap(command, options->job.placement.memory_cap_bytes);
}

}  // namespace sculpt::cli
