// sculpt sample: where the joints are at fixed times, for a driver that takes them so.
#include <charconv>
#include <cmath>
#include <iostream>
#include <memory>
#include <vector>

#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cli/files.hpp"
#include "clients/cli/motion/motion_options.hpp"
#include "core/timing/motion/sampler.hpp"

namespace sculpt::cli {

namespace {

struct SampleOptions {
  MotionOptions motion;
  double rate_hz = 0, from_s = 0, to_s = -1;
  std::vector<double> holds_s;
  std::string output;
};

/// Sixteen digits tell any two values apart that a controller could.
void append(std::string& line, double value) {
  char text[32];
  const auto end =
      std::to_chars(text, text + sizeof text, value == 0 ? 0.0 : value, std::chars_format::general, 10).ptr;
  line.append(text, end);
}

void write_row(std::ostream& out, double time_s, const MotionSample& sample) {
  std::string line;
  char text[32];
  line.append(text, std::to_chars(text, text + sizeof text, time_s, std::chars_format::fixed, 6).ptr);
  for (const Configuration* values : {&sample.q, &sample.velocity})
    for (const double value : *values) {
      line += ',';
      append(line, value);
    }
  out << line << '\n';
}

int run_sample(const std::string& server, const SampleOptions& options) {
  const PlanPath path = read_path(server, options.motion);
  const Cell cell = read_cell_of(server, path, options.motion);
  const TimedPlan plan = time_plan(path, cell, to_demands(options.motion, path));
  MotionSampler sampler(path, plan.law);
  sampler.hold(options.holds_s);
  const double end_s = options.to_s < 0 ? sampler.duration_s() : options.to_s;
  if (options.from_s > end_s || options.from_s > sampler.duration_s())
    throw Failure(
        exit_refused, "window_empty",
        "the motion ends at " + std::to_string(sampler.duration_s()) + " s: give --from before that and before --to");
  PartFile file(options.output);
  std::ostream& out = file.stream();
  out << "t";
  for (const char* what : {"", "_velocity"})
    for (const std::string& joint : path.header().joints) out << ',' << joint << what;
  out << '\n';
  const auto first = static_cast<std::uint64_t>(std::ceil(options.from_s * options.rate_hz - 1e-9)),
             last =
                 static_cast<std::uint64_t>(std::floor(std::min(end_s, sampler.duration_s()) * options.rate_hz + 1e-9));
  for (std::uint64_t at = first; at <= last; ++at) {
    const double time_s = static_cast<double>(at) / options.rate_hz;
    write_row(out, time_s, sampler.at(time_s));
  }
  // Where nothing was cut off, the end itself: the motion comes to rest between two samples.
  if (options.to_s < 0 && static_cast<double>(last) / options.rate_hz < sampler.duration_s())
    write_row(out, static_cast<double>(last + 1) / options.rate_hz, sampler.at(sampler.duration_s()));
  file.finish();
  return exit_fine;
}

}  // namespace

void add_sample(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<SampleOptions>();
  CLI::App& command =
      add_command(app, invocation, "sample",
                  "Write where the joints of a plan are, and how fast, at a fixed rate: for drivers that "
                  "stream positions",
                  [&invocation, options] { return run_sample(invocation.server, *options); });
  add_motion_options(command, options->motion);
  command.add_option("--rate", options->rate_hz, "Samples a second")
      ->type_name("HZ")
      ->check(CLI::Range(0.001, 1e6))
      ->required();
  command.add_option("--from", options->from_s, "Seconds from the start of the motion")
      ->type_name("S")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_option("--to", options->to_s, "Seconds from the start of the motion; without it to its end")
      ->type_name("S")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--hold", options->holds_s,
                  "Come to rest on the path from this second on, and go on; more than one in their order")
      ->type_name("S,...")
      ->delimiter(',')
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("-o,--output", options->output, "The table (.csv): t, each joint, each joint's velocity; rad or m, s")
      ->type_name("FILE")
      ->required();
}

}  // namespace sculpt::cli
