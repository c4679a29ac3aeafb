// sculpt time: how long a plan takes on its robot, and when the joints are where.
#include <iostream>
#include <memory>

#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cli/files.hpp"
#include "clients/cli/motion_options.hpp"
#include "clients/cli/time_table.hpp"
#include "core/law/law_file.hpp"

namespace sculpt::cli {

namespace {

struct TimeOptions {
  MotionOptions motion;
  bool json = false;
  std::string output;
};

void write(const PlanPath& path, const TimeLaw& law, const std::string& output) {
  PlanMark mark;
  std::size_t point = 0;
  for (std::uint64_t keyframe = 1; keyframe <= path.keyframes(); ++keyframe) {
    if (point + 1 < path.size() && path.edge_to(point + 1).keyframe == keyframe) ++point;
    mark.add(path.configuration(point));
  }
  PartFile file(output);
  write_law(file.stream(), law, mark);
  file.finish();
}

int run_time(const std::string& server, const TimeOptions& options) {
  const PlanPath path = read_path(server, options.motion);
  const Cell cell = read_cell_of(path, options.motion);
  const TimedPlan plan = time_plan(path, cell, to_demands(options.motion));
  if (!options.output.empty()) write(path, plan.law, options.output);
  const Json report = time_report(path, plan);
  std::cout << (options.json ? proto::write_json(report) + "\n" : time_table(report));
  return exit_fine;
}

}  // namespace

void add_time(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<TimeOptions>();
  CLI::App& command = add_command(app, invocation, "time",
                                  "How long a plan takes at a feed, within the joints' velocity, acceleration and jerk",
                                  [&invocation, options] { return run_time(invocation.server, *options); });
  add_motion_options(command, options->motion);
  command.add_flag("--json", options->json, "Print the figures as one JSON document");
  command.add_option("-o,--output", options->output, "Write the time law there: 16 bytes a keyframe")
      ->type_name("FILE");
}

}  // namespace sculpt::cli
