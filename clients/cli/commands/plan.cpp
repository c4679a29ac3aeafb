// sculpt plan: the same planner in this process, without a server.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cli/files.hpp"
#include "clients/cli/interrupt.hpp"
#include "clients/cli/job_options.hpp"
#include "clients/cli/progress_line.hpp"
#include "clients/cli/report_table.hpp"
#include "core/base/extension.hpp"
#include "core/material/binvox.hpp"
#include "core/material/clamping.hpp"
#include "core/plan/output/surface_file.hpp"
#include "core/trajectory/export.hpp"

namespace sculpt::cli {

namespace {

struct PlanOptions {
  JobOptions job;
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  bool json = false;
  std::string output, surface;
  std::vector<double> turn_over_deg;  ///< empty or roll, pitch, yaw
};

/// Nothing if none was asked for.
std::optional<CubeTurn> read_turn_over(const PlanOptions& options) {
  if (options.turn_over_deg.empty()) return std::nullopt;
  const std::vector<double>& deg = options.turn_over_deg;
  const auto turn = cube_turn(Vec3(deg[0], deg[1], deg[2]) * (std::numbers::pi / 180));
  if (!turn)
    throw Failure(exit_usage, "usage", "--turn-over turns by quarters: give multiples of 90, for example 180,0,0");
  return turn;
}

/// What the next clamping begins with.
void write_turned_over(const JobResult& result, const CubeTurn& turn, const std::string& output) {
  const VoxelGrid next = clamp_anew(result.voxels, find_left(result), turn);
  for (const auto& [name, voxels] :
       {std::pair(".target.binvox", &next.keep), std::pair(".stock.binvox", &next.stock)}) {
    PartFile file(output + name);
    file.stream() << write_binvox(*voxels, result.grid);
    file.finish();
  }
}

/// `plan`: the trajectory, by now whole.
void write_surface(const std::string& name, const Job& job, const std::filesystem::path& plan, const Watch& watch) {
  std::ifstream in(plan, std::ios::binary);
  PartFile file(name);
  write_machined_surface(job, in, file.stream(), watch);
  file.finish();
}

int run_plan(const PlanOptions& options) {
  const std::string extension = extension_of(options.output);
  if (extension != "ndjson" && extension != "csv" && extension != "sct")
    throw Failure(exit_usage, "format_unknown",
                  "cannot tell the format of " + options.output + " from its name: end it in .ndjson, .csv or .sct");
  if (!options.surface.empty() && options.job.mill.tools.empty())
    throw Failure(exit_usage, "usage", "--surface is what milling tools leave: name them with --tools");
  const std::optional<CubeTurn> turn_over = read_turn_over(options);
  Job job = read_job(options.job);
  job.threads = options.threads;
  job.keep_fields = cache_folder();

  std::stop_source stop;
  const Interrupt interrupt([&stop] { stop.request_stop(); });
  ProgressLine progress(STDERR_FILENO, PlainLines::each_second);
  bool warned = false;
  const Watch watch{stop.get_token(), [&](const Progress& at) {
                      if (at.doubts.keep > 0 && !std::exchange(warned, true)) {
                        progress.clear();
                        for (const std::string& line : doubt_lines(at.doubts)) std::cerr << "sculpt: " << line << "\n";
                      }
                      progress.tell(name(at.stage), at.done, at.total);
                    }};
  // As a table it is only made once it is whole: until then it is kept in the shortest form.
  const bool as_table = extension == "csv";
  PartFile output(options.output);
  std::optional<PartFile> plan;
  if (as_table) plan.emplace(options.output + ".sct");
  const std::filesystem::path& written = as_table ? plan->part() : output.part();
  const JobResult result =
      run_job(job, written, watch, extension == "ndjson" ? TrajectoryForm::text : TrajectoryForm::binary);
  if (as_table) {
    std::ifstream in(written, std::ios::binary);
    export_csv(in, output.stream());
  }
  if (!options.surface.empty()) write_surface(options.surface, job, written, watch);
  output.finish();
  if (turn_over) write_turned_over(result, *turn_over, options.output);
  progress.clear();

  const std::string report = report_json(result.report);
  std::cout << (options.json ? report + "\n" : report_table(proto::parse_json(report)));
  for (const std::string& finding : result.report.findings) std::cerr << "sculpt: verify: " << finding << "\n";
  return result.report.verify.clean ? exit_fine : exit_failed;
}

}  // namespace

void add_plan(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<PlanOptions>();
  CLI::App& command = add_command(app, invocation, "plan", "Plan in this process, without a server",
                                  [options] { return run_plan(*options); });
  add_job_options(command, options->job);
  add_memory_cap(command, options->job.placement.memory_cap_bytes);
  command.add_option("--threads", options->threads, "Worker threads; the plan is the same at any number")
      ->type_name("T")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command.add_flag("--json", options->json, "Print the report as one JSON document");
  command
      .add_option("--turn-over", options->turn_over_deg,
                  "Write where a second clamping begins, turned by quarters about x, y, z: FILE.target.binvox and "
                  "FILE.stock.binvox")
      ->type_name("R,P,Y")
      ->delimiter(',')
      ->expected(3);
  command
      .add_option("--surface", options->surface,
                  "With --tools: the surface as they leave it, with what stands above it at each vertex")
      ->type_name("FILE.ply");
  command.add_option("-o,--output", options->output, "The trajectory: .ndjson, .csv or .sct by extension")
      ->type_name("FILE")
      ->required();
}

}  // namespace sculpt::cli
