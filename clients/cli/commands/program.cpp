// sculpt program: a plan in the language of a controller.
#include <filesystem>
#include <iostream>
#include <memory>

#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cli/files.hpp"
#include "clients/cli/motion/motion_options.hpp"
#include "core/program/make_program.hpp"

namespace sculpt::cli {

namespace fs = std::filesystem;

namespace {

struct ProgramOptions {
  MotionOptions motion;
  std::string dialect, output;
  std::optional<std::size_t> part_keyframes;
  std::optional<std::uint64_t> part_bytes;
  bool stock_files = false, in_stock = false, json = false;
};

int run_program(const std::string& server, const ProgramOptions& options) {
  const PlanPath path = read_path(server, options.motion);
  const Cell cell = read_cell_of(server, path, options.motion);
  ProgramDemands demands;
  demands.dialect = parse_dialect(options.dialect);
  const fs::path folder = fs::path(options.output).lexically_normal();
  demands.name = folder.filename().empty() ? folder.parent_path().filename().string() : folder.filename().string();
  demands.motion = to_demands(options.motion, path);
  demands.stock_files = options.stock_files;
  demands.seams_in_stock = options.in_stock;
  demands.part_keyframes = options.part_keyframes;
  demands.part_bytes = options.part_bytes;
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed)
    throw Failure(exit_usage, "file_unwritable",
                  "cannot make the folder " + folder.string() + " (" + failed.message() + "): choose another -o");
  const ProgramReport report = make_program(path, cell, demands, [&](const ProgramFile& file) {
    PartFile out(folder / file.name);
    out.stream() << file.text;
    out.finish();
  });
  const Json json{{"dialect", options.dialect},      {"parts", report.parts},
                  {"files", report.files},           {"moves", report.moves},
                  {"bytes", report.bytes},           {"seconds", report.seconds},
                  {"rounding_m", report.rounding_m}, {"retreat_moves", report.retreat_moves}};
  if (options.json) {
    std::cout << proto::write_json(json) << "\n";
  } else {
    std::cout << report.files << " files in " << folder.string() << ": " << report.parts << " parts, " << report.moves
              << " moves, " << report.bytes << " bytes; " << static_cast<long long>(report.seconds) << " s of motion\n";
  }
  return exit_fine;
}

}  // namespace

void add_program(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<ProgramOptions>();
  CLI::App& command =
      add_command(app, invocation, "program",
                  "Write a plan in the language of a controller: each part is read back and held against "
                  "the plan before it is handed out",
                  [&invocation, options] { return run_program(invocation.server, *options); });
  add_motion_options(command, options->motion);
  command.add_option("--dialect", options->dialect, "Of KUKA, ABB, Universal Robots, FANUC, LinuxCNC, ROS 2")
      ->required()
      ->check(CLI::IsMember({"krl", "rapid", "urscript", "fanuc", "gcode", "ros2"}));
  command
      .add_option("--part-keyframes", options->part_keyframes,
                  "Keyframes in a part at most; without it what the controller takes")
      ->type_name("M");
  command
      .add_option("--part-bytes", options->part_bytes,
                  "Bytes of a part's files at most, also where it has fewer keyframes")
      ->type_name("B");
  command.add_flag("--stock-files", options->stock_files,
                   "With each part what stands when it begins (.binvox): the stock's cube less what is cut");
  command.add_flag("--seams-in-stock", options->in_stock,
                   "Let parts begin and end with the tool in the material: such a part cannot simply be run again");
  command.add_flag("--json", options->json, "Print the figures as one JSON document");
  command.add_option("-o,--output", options->output, "A folder; its name is that of the program")
      ->type_name("FOLDER")
      ->required();
}

}  // namespace sculpt::cli
