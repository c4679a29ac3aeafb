// sculpt render: a picture of a plan, without a browser.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include "clients/cli/cell/png_file.hpp"
#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cli/files.hpp"
#include "clients/cli/job_options.hpp"
#include "core/base/extension.hpp"
#include "core/picture/draw_plan.hpp"

namespace sculpt::cli {

namespace {

struct RenderOptions {
  std::string subject;  ///< a job or a file
  std::string output, robot;
  double at = 1;
  PlanPictureSettings picture;
};

StockMoment moment_of_file(const RenderOptions& options) {
  const std::string bytes = read_input(options.subject, "plan");
  if (!is_timeline(bytes)) {
    std::istringstream trajectory(bytes);
    return moment_of_trajectory(trajectory, options.at);
  }
  if (!options.robot.empty())
    throw Failure(
        exit_usage, "usage",
        options.subject + " is a timeline, which says nothing of joints: name the trajectory, or leave out --robot");
  return moment_of_timeline(bytes, options.at, true);
}

std::string read_now(client::Client& client, const client::ArtifactRequest& request) {
  std::ostringstream bytes;
  client.read_artifact(request, bytes, [] { return false; });
  return std::move(bytes).str();
}

/// Of a job that is still planned: as far as it has come.
StockMoment moment_of_job(const std::string& server, const RenderOptions& options) {
  client::Client client = connect(server);
  const bool ended = client::is_final(client.call("job.get", {{"job", options.subject}}).at("state"));
  StockMoment moment = moment_of_timeline(read_now(client, {options.subject, "timeline"}), options.at, ended);
  if (!options.robot.empty()) {
    std::istringstream trajectory(read_now(client, {options.subject, "trajectory", "binary"}));
    moment.q = moment_of_trajectory(trajectory, options.at).q;
  }
  return moment;
}

int run_render(const std::string& server, const RenderOptions& options) {
  if (extension_of(options.output) != "png")
    throw Failure(exit_usage, "usage", "a picture is a .png: -o " + options.output + ".png");
  std::optional<Cell> cell;
  if (!options.robot.empty()) cell = parse_cell(read_cell(options.robot));
  const bool is_file = std::filesystem::exists(options.subject) || !extension_of(options.subject).empty();
  const StockMoment moment = is_file ? moment_of_file(options) : moment_of_job(server, options);
  write_png(options.output, draw_plan(moment, cell ? &*cell : nullptr, options.picture));
  std::cout << options.output << ": " << moment.removed << " voxels removed, " << moment.left.size() << " left over\n";
  return exit_fine;
}

}  // namespace

void add_render(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App& command = add_command(
      app, invocation, "render",
      "Draw the stock at a moment of a plan: of a JOB, as far as it has come, or of a FILE here. The same plan gives "
      "the same bytes",
      [&invocation, options] { return run_render(invocation.server, *options); });
  command
      .add_option("subject", options->subject,
                  "The id of a job, a trajectory (.ndjson or .sct: the stock is taken to fill the grid) or a timeline")
      ->type_name("JOB|FILE")
      ->required();
  command.add_option("--at", options->at, "The moment: a share of the plan's keyframes, 0 to 1")
      ->type_name("SHARE")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command.add_option("-o,--output", options->output, "Where to write")->type_name("FILE.png")->required();
  command.add_option("--from", options->picture.side, "The side that it is seen from")
      ->check(CLI::IsMember(picture_sides()))
      ->capture_default_str();
  command.add_option("--pixels", options->picture.pixels, "Along each edge of the picture")
      ->type_name("P")
      ->check(CLI::Range(16, 4096))
      ->capture_default_str();
  command.add_option("--robot", options->robot, "Draw this cell around it: the one that it was planned for")
      ->type_name("CELL");
}

}  // namespace sculpt::cli
