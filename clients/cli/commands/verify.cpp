// sculpt verify: a job by its server, or a file by the replay in this process.
#include "core/verify/verify.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <thread>

#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cli/files.hpp"
#include "clients/cli/interrupt.hpp"
#include "clients/cli/job_options.hpp"
#include "clients/cli/progress_line.hpp"
#include "clients/cpp/client.hpp"
#include "core/base/extension.hpp"
#include "core/material/resolution.hpp"
#include "core/plan/plan.hpp"
#include "core/trajectory/reader.hpp"

namespace sculpt::cli {

namespace {

struct VerifyOptions {
  std::string subject;  ///< a job or a file
  std::string mesh, robot;
  std::optional<int> resolution;
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  bool json = false, thorough = false;
  PlacementOptions placement;
};

/// A line for each reason.
void print_exempt(const Json& pairs) {
  std::map<std::string, std::string> links;
  for (const Json& pair : pairs) {
    std::string& list = links[pair.at("why").get<std::string>()];
    list += (list.empty() ? "" : ", ") + pair.at("links").at(0).get<std::string>() + " and " +
            pair.at("links").at(1).get<std::string>();
  }
  for (const auto& [why, list] : links) std::cout << "  may touch (" << why << "): " << list << "\n";
}

int print_verdict(const VerifyOptions& options, const Json& verdict) {
  if (options.json) {
    std::cout << proto::write_json(verdict) << "\n";
  } else {
    const bool clean = verdict.at("clean");
    std::cout << options.subject << ": " << (clean ? "clean" : "NOT CLEAN") << ", " << verdict.at("voxels_checked")
              << " voxels checked, " << verdict.at("collisions") << " findings\n";
    for (const Json& finding : verdict.value("findings", Json::array()))
      std::cout << "  line " << finding.at("line") << ": " << finding.at("sentence").get<std::string>() << "\n";
    print_exempt(verdict.value("exempt_pairs", Json::array()));
  }
  return verdict.at("clean").get<bool>() ? exit_fine : exit_failed;
}

Json to_json(const VerifyOptions& options, const Verdict& verdict) {
  Json findings = Json::array();
  for (const Finding& finding : verdict.findings)
    findings.push_back({{"line", finding.line}, {"sentence", finding.sentence}});
  Json exempt = Json::array();
  for (const ExemptPair& pair : verdict.exempt_pairs)
    exempt.push_back({{"links", {pair.first, pair.second}}, {"why", pair.why}});
  return {{"file", options.subject},
          {"clean", verdict.clean},
          {"collisions", verdict.collisions},
          {"voxels_checked", verdict.voxels_checked},
          {"freed", verdict.freed},
          {"findings", findings},
          {"exempt_pairs", exempt}};
}

/// A plan of a fine block is long: it is read from the file as it is needed.
std::unique_ptr<std::istream> open_trajectory(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored))
    if (auto file = std::make_unique<std::ifstream>(path, std::ios::binary); *file) return file;
  return std::make_unique<std::istringstream>(read_input(path, "trajectory"));  // a pipe, or says what is wrong
}

int verify_file(const VerifyOptions& options) {
  if (options.mesh.empty() || options.robot.empty())
    throw Failure(exit_usage, "usage", options.subject + " is a file: say --mesh and --robot too, to replay it here");
  const std::unique_ptr<std::istream> trajectory = open_trajectory(options.subject);
  Job job;
  job.mesh = read_mesh_file(options.mesh, "mesh");
  job.stock = read_stock(options.placement);
  job.placement = to_placement(options.placement);
  job.memory_cap_bytes = options.placement.memory_cap_bytes;
  job.cell = read_cell(options.robot);
  job.resolution = options.resolution.value_or(TrajectoryReader(*trajectory).header().grid.n);
  trajectory->clear();
  trajectory->seekg(0);

  std::stop_source stop;
  const Interrupt interrupt([&stop] { stop.request_stop(); });
  ProgressLine progress(STDERR_FILENO, PlainLines::each_second);
  const Watch watch{stop.get_token(), [&](const Progress& at) { progress.tell(name(at.stage), at.done, at.total); }};
  check_resolution(job.resolution);
  const Verdict verdict = replay_plan(*trajectory, job, watch, {options.threads, options.thorough});
  progress.clear();
  return print_verdict(options, to_json(options, verdict));
}

int verify_job(const std::string& server, const VerifyOptions& options) {
  client::Client client = connect(server);
  return print_verdict(options, client.call("job.verify", {{"job", options.subject}}));
}

int run_verify(const std::string& server, const VerifyOptions& options) {
  const std::string extension = extension_of(options.subject);
  const bool is_file = !options.mesh.empty() || !options.robot.empty() || extension == "ndjson" || extension == "sct" ||
                       std::filesystem::exists(options.subject);
  return is_file ? verify_file(options) : verify_job(server, options);
}

}  // namespace

void add_verify(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<VerifyOptions>();
  CLI::App& command =
      add_command(app, invocation, "verify",
                  "Replay a trajectory with FCL and kinematics of its own: a JOB on the server, or a FILE here. "
                  "Exit 0 only if it is clean",
                  [&invocation, options] { return run_verify(invocation.server, *options); });
  command.add_option("subject", options->subject, "The id of a job, or a trajectory (.ndjson or .sct)")
      ->type_name("JOB|FILE")
      ->required();
  command.add_option("--mesh", options->mesh, "FILE only: the sculpture that was planned")->type_name("MESH");
  command.add_option("--robot", options->robot, "FILE only: the cell that it was planned for")->type_name("CELL");
  command.add_flag("--thorough", options->thorough,
                   "FILE only: FCL and octomap decide all, motion by motion; slow, and of the same verdict");
  command.add_option("--resolution", options->resolution, "FILE only: default is what the file's header says")
      ->type_name("N");
  command.add_option("--threads", options->threads, "FILE only: worker threads; the verdict is the same at any number")
      ->type_name("T")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command.add_flag("--json", options->json, "Print the verdict as one JSON document");
  add_placement_options(command, options->placement);
  add_memory_cap(command, options->placement.memory_cap_bytes);
}

}  // namespace sculpt::cli
