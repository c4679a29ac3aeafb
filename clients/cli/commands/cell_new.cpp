// sculpt cell new: a cell from a maker's URDF.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <thread>

#include "clients/cli/cell/cell_table.hpp"
#include "clients/cli/cell/makers_robot.hpp"
#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cli/files.hpp"
#include "clients/cli/interrupt.hpp"
#include "core/doctor/examine.hpp"
#include "core/doctor/findings_json.hpp"

namespace sculpt::cli {

namespace {

namespace fs = std::filesystem;

struct NewCellOptions {
  std::string urdf, output, table = "turntable";
  std::string tool_link, stock_link;
  std::vector<std::string> packages, without;
  std::vector<double> stock_at_m, spindle_m;
  std::optional<double> stock_size_m, stickout_m, table_radius_m, ball_radius_m;
  bool no_floor = false, force = false;
};

CellWishes to_wishes(const NewCellOptions& options) {
  CellWishes wishes;
  wishes.tool_link = options.tool_link;
  wishes.stock_link = options.stock_link;
  wishes.stock_size_m = options.stock_size_m;
  wishes.stickout_m = options.stickout_m;
  wishes.ball_radius_m = options.ball_radius_m;
  wishes.table_radius_m = options.table_radius_m;
  wishes.floor = !options.no_floor;
  wishes.table = !options.stock_link.empty() ? Table::none : options.table == "fixed" ? Table::fixed : Table::turntable;
  if (const auto& at = options.stock_at_m; !at.empty()) wishes.table_at_m = Vec3(at[0], at[1], at[2]);
  if (!options.spindle_m.empty()) {
    wishes.spindle_radius_m = options.spindle_m[0];
    wishes.spindle_length_m = options.spindle_m[1];
  }
  return wishes;
}

void refuse_existing(const fs::path& file, bool force) {
  if (!force && fs::exists(file))
    throw Failure(exit_usage, "file_exists", file.string() + " is there already: choose another name, or add --force");
}

void write_text(const fs::path& file, const std::string& text) {
  PartFile output(file);
  output.stream() << text;
  output.finish();
}

int run_new(const NewCellOptions& options) {
  const fs::path cell_file = options.output, folder = fs::absolute(cell_file).parent_path();
  if (cell_file.extension() != ".json")
    throw Failure(exit_usage, "usage", "a cell file ends in .json: -o " + cell_file.string() + ".json");
  fs::path urdf_file = cell_file;
  urdf_file.replace_extension(".urdf");
  std::error_code ignored;
  if (fs::equivalent(urdf_file, options.urdf, ignored))
    throw Failure(exit_usage, "usage",
                  urdf_file.string() +
                      " is the robot's own file, and would be written over: choose another name than " +
                      cell_file.string() + " for the cell, or write it into another folder");
  refuse_existing(cell_file, options.force);
  refuse_existing(urdf_file, options.force);

  std::stop_source stop;
  const Interrupt interrupt([&stop] { stop.request_stop(); });
  const Watch watch{stop.get_token(), {}};
  const Helpers helpers(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
  const RobotFolder source(options.urdf, options.packages, options.without);
  const NewCell made = make_cell(source.robot(), to_wishes(options), {0, helpers, watch});
  write_text(urdf_file, source.seen_from(folder, made.urdf));
  write_text(cell_file, cell_text(made.cell, urdf_file.filename().string(), source.packages(folder)));

  // Read back as everybody will.
  ExamineSettings quick;
  quick.fields = false;
  const CellFindings read = examine_cell(draft_cell(read_cell_files(cell_file)), quick, {0, helpers, watch});
  const Json found = proto::parse_json(findings_json(read));
  std::cout << cell_file.string() << " and " << urdf_file.string() << " written\n";
  for (const std::string& remark : made.remarks) std::cout << "  " << remark << "\n";
  std::cout << cell_line(found) << fault_lines(found);
  return read.plannable() ? exit_fine : exit_failed;
}

}  // namespace

void add_cell_new(CLI::App& cell, Invocation& invocation) {
  const auto options = std::make_shared<NewCellOptions>();
  CLI::App& command =
      add_command(cell, invocation, "new", "Write a cell from a maker's URDF", [options] { return run_new(*options); });
  command.add_option("urdf", options->urdf, "The robot: a URDF, or a xacro source where xacro is installed")
      ->type_name("URDF")
      ->required();
  command.add_option("-o,--output", options->output, "The cell file; its URDF is written beside it")
      ->type_name("CELL.json")
      ->required();
  command.add_option("--tool-link", options->tool_link, "The flange; without it the end of the longest row of joints")
      ->type_name("LINK");
  command.add_option("--stickout", options->stickout_m, "From the spindle's nose to the centre of the ball")
      ->type_name("METRES");
  command.add_option("--spindle", options->spindle_m, "Radius and length of the spindle on the flange; 0,0 for none")
      ->type_name("R,L")
      ->delimiter(',')
      ->expected(2);
  command.add_option("--ball-radius", options->ball_radius_m, "Of ball and shank; without it they follow the voxels")
      ->type_name("METRES");
  command.add_option("--stock-size", options->stock_size_m, "Edge of the stock's cube")->type_name("METRES");
  CLI::Option* link =
      command.add_option("--stock-link", options->stock_link, "The stock stands on this link of the URDF")
          ->type_name("LINK");
  command.add_option("--table", options->table, "What is put under the stock where the URDF has no table")
      ->check(CLI::IsMember({"turntable", "fixed"}))
      ->capture_default_str()
      ->excludes(link);
  command
      .add_option("--stock-at", options->stock_at_m,
                  "The middle of the table's top, seen from the URDF's root; without it a place is found")
      ->type_name("X,Y,Z")
      ->delimiter(',')
      ->expected(3)
      ->excludes(link);
  command.add_option("--table-radius", options->table_radius_m, "Without it as wide as the stock")
      ->type_name("METRES")
      ->excludes(link);
  command.add_flag("--no-floor", options->no_floor, "Put no floor under robot and table")->excludes(link);
  command.add_option("--without", options->without, "Take this link out, with what hangs on it: a gripper, say")
      ->type_name("LINK");
  command.add_option("--package", options->packages, "Where a ROS package lies that the URDF names")
      ->type_name("NAME=FOLDER");
  command.add_flag("--force", options->force, "Write over files that are there");
}

}  // namespace sculpt::cli
