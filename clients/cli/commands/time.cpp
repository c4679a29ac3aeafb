// sculpt time: how long a plan takes on its robot, and when the joints are where.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <stop_token>

#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cli/files.hpp"
#include "clients/cli/interrupt.hpp"
#include "clients/cli/motion/motion_options.hpp"
#include "clients/cli/time_table.hpp"
#include "core/law/law_file.hpp"
#include "core/verify/timed/check_motion.hpp"

namespace sculpt::cli {

namespace {

struct TimeOptions {
  MotionOptions motion;
  bool json = false, check = false;
  std::string output;
};

/// By the checker, which shares nothing with what made the law.
Json check(const LawFile& law, const Cell& cell, const TimeOptions& options) {
  std::stop_source stop;
  const Interrupt interrupt([&stop] { stop.request_stop(); });
  std::ifstream in(options.motion.subject, std::ios::binary);
  const MotionVerdict verdict = check_motion(in, law, cell, {stop.get_token(), {}});
  Json findings = Json::array();
  for (const MotionFinding& finding : verdict.findings)
    findings.push_back({{"keyframe", finding.keyframe}, {"sentence", finding.sentence}});
  return {{"clean", verdict.faults == 0},
          {"faults", verdict.faults},
          {"findings", findings},
          {"pieces", verdict.pieces},
          {"samples", verdict.samples},
          {"total_s", verdict.total_s},
          {"velocity", verdict.velocity},
          {"acceleration", verdict.acceleration},
          {"jerk", verdict.jerk},
          {"feed_m_s", verdict.feed_m_s},
          {"ball_voxels", verdict.ball_voxels},
          {"cutter_m", verdict.cutter_m},
          {"links_m", verdict.links_m}};
}

void print_check(const Json& check) {
  const auto value = [&](const char* name) { return check.at(name).get<double>(); };
  std::ostringstream line;
  line.precision(5);
  line << "check: " << (check.at("clean").get<bool>() ? "clean" : "NOT CLEAN") << ", " << check.at("pieces")
       << " pieces, " << check.at("samples") << " samples; at most " << value("velocity") << " of a velocity, "
       << value("acceleration") << " of an acceleration, " << value("jerk") << " of a jerk, " << value("feed_m_s")
       << " m/s on cuts; ball " << value("ball_voxels") << " voxels and cutter " << 1e6 * value("cutter_m")
       << " um off the path, links " << 1e6 * value("links_m") << " um nearer than on it";
  std::cout << line.str() << "\n";
  for (const Json& finding : check.at("findings"))
    std::cout << "  keyframe " << finding.at("keyframe") << ": " << finding.at("sentence").get<std::string>() << "\n";
}

int run_time(const std::string& server, const TimeOptions& options) {
  std::error_code ignored;
  if (options.check && !std::filesystem::is_regular_file(options.motion.subject, ignored))
    throw Failure(exit_usage, "usage",
                  "--check reads the plan twice: fetch " + options.motion.subject + " first, and name the file");
  const PlanPath path = read_path(server, options.motion);
  const Cell cell = read_cell_of(server, path, options.motion);
  TimedPlan plan = time_plan(path, cell, to_demands(options.motion, path));
  Json report = time_report(path, plan);
  LawFile law{std::move(plan.law), {}};
  if (options.check || !options.output.empty()) law.plan = mark_of(path);
  if (!options.output.empty()) {
    PartFile file(options.output);
    write_law(file.stream(), law.law, law.plan);
    file.finish();
  }
  if (options.check) report["check"] = check(law, cell, options);
  std::cout << (options.json ? proto::write_json(report) + "\n" : time_table(report));
  if (!options.check) return exit_fine;
  if (!options.json) print_check(report.at("check"));
  return report.at("check").at("clean").get<bool>() ? exit_fine : exit_failed;
}

}  // namespace

void add_time(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<TimeOptions>();
  CLI::App& command = add_command(app, invocation, "time",
                                  "How long a plan takes at a feed, within the joints' velocity, acceleration and jerk",
                                  [&invocation, options] { return run_time(invocation.server, *options); });
  add_motion_options(command, options->motion);
  command.add_flag("--json", options->json, "Print the figures as one JSON document");
  command.add_flag(
      "--check", options->check,
      "FILE only: replay the motion at 1000 samples a second by code of its own; exit 1 if it does not keep "
      "limits, feed and path");
  command.add_option("-o,--output", options->output, "Write the time law there: 16 bytes a keyframe")
      ->type_name("FILE");
}

}  // namespace sculpt::cli
