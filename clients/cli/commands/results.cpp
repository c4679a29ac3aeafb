// sculpt report, fetch, link: what a job has to show for itself.
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string_view>
#include <vector>

#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cli/files.hpp"
#include "clients/cli/interrupt.hpp"
#include "clients/cli/job_end.hpp"
#include "clients/cli/motion/program_order.hpp"
#include "clients/cli/report_table.hpp"

namespace sculpt::cli {

namespace {

const std::vector<std::string> artifact_names{"trajectory", "timeline", "voxels", "stock",
                                              "surface",    "residue",  "report", "program"},
    format_names{"ndjson", "binary", "csv", "tokens", "gzip", "binvox", "zip"};

struct ReportOptions {
  std::string job;
  bool json = false;
};

struct FetchOptions {
  std::string job, output, format;
  std::string artifact = "trajectory";
  ProgramOrder program;
};

struct LinkOptions {
  std::string job, artifact = "trajectory", format;
  ProgramOrder program;
  bool json = false;
};

/// What begins a URL of this server.
std::string url_of(const std::string& server) {
  constexpr std::string_view unix_socket = "unix:", tls = "tls:";
  if (server.starts_with(unix_socket))
    throw Failure(
        exit_usage, "usage",
        "no browser or player opens " + server + ": add --server HOST:PORT, an address that the server listens on");
  return server.starts_with(tls) ? "https://" + server.substr(tls.size()) : "http://" + server;
}

int run_link(const std::string& server, const LinkOptions& options) {
  const std::string url = url_of(server);
  const Json program = program_field(options.program, options.artifact);
  client::Client client = connect(server);
  Json request{{"job", options.job}, {"artifact", options.artifact}};
  if (!options.format.empty()) request["format"] = options.format;
  if (!program.is_null()) request["program"] = program;
  Json link = client.call("artifact.link", request);
  link["url"] = url + link.at("path").get<std::string>();
  std::cout << (options.json ? proto::write_json(link) : link.at("url").get<std::string>()) << "\n";
  if (!options.json) std::cerr << "good until " << link.at("expires_at").get<std::string>() << "\n";
  return exit_fine;
}

int run_report(const std::string& server, const ReportOptions& options) {
  client::Client client = connect(server);
  const Json report = client.call("job.report", {{"job", options.job}});
  std::cout << (options.json ? proto::write_json(report) + "\n" : report_table(report));
  return exit_fine;
}

/// Only these can be read while they grow; for all else the job must have ended.
bool grows(const FetchOptions& options) {
  if (options.artifact == "trajectory") return options.format.empty() || options.format == "ndjson";
  return options.artifact == "timeline" && options.format != "gzip";
}

/// A trajectory that failed its replay may be looked at; of other jobs that did not succeed there is nothing whole.
bool is_whole(const Json& end) {
  const std::string error = end.value("error", Json::object()).value("code", "");
  return end.value("state", "") == "succeeded" || error == "verify_failed" || error == "feed_not_kept";
}

int run_fetch(const std::string& server, const FetchOptions& options) {
  client::ArtifactRequest request;
  request.job = options.job;
  request.artifact = options.artifact;
  request.format = options.format;
  request.program = program_field(options.program, options.artifact);
  client::Client client = connect(server);
  Json end = grows(options) ? client.call("job.get", {{"job", options.job}}) : wait_job(client, options.job);
  if (client::is_final(end.value("state", "")) && !is_whole(end)) return end_exit_code(end);

  if (options.output == "-") {
    client.read_artifact(request, std::cout);
    end = wait_job(client, options.job);
    return end_exit_code(end);
  }
  const Interrupt interrupt([&options] {
    std::error_code ignored;
    std::filesystem::remove(options.output + ".part", ignored);
    std::cerr << "\nsculpt: interrupted: " << options.output << " was not written; job " << options.job << " goes on\n";
    std::_Exit(exit_failed);
  });
  PartFile output(options.output);
  client.read_artifact(request, output.stream());
  end = wait_job(client, options.job);
  if (is_whole(end)) output.finish();
  return end_exit_code(end);
}

}  // namespace

void add_report(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App& command = add_command(app, invocation, "report", "The figures of a finished job",
                                  [&invocation, options] { return run_report(invocation.server, *options); });
  command.add_option("job", options->job, "The id that submit printed")->type_name("JOB")->required();
  command.add_flag("--json", options->json, "Print the report as one JSON document");
}

void add_fetch(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<FetchOptions>();
  CLI::App& command = add_command(app, invocation, "fetch",
                                  "Get a result. Of a job that still runs it waits for the end, writing the ndjson "
                                  "trajectory as it grows; FILE gets its name when it is whole",
                                  [&invocation, options] { return run_fetch(invocation.server, *options); });
  command.add_option("job", options->job, "The id that submit printed")->type_name("JOB")->required();
  command.add_option("-o,--output", options->output, "Where to write, or - for stdout")->type_name("FILE")->required();
  command
      .add_option(
          "--format", options->format,
          "Form of the trajectory: ndjson (default), binary or csv; of the timeline: tokens (default) or gzip, as "
          "of the residue; of the stock: binvox (default) or, with milling tools, zip, what stands after each of them")
      ->check(CLI::IsMember(format_names));
  command
      .add_option("--artifact", options->artifact,
                  "trajectory, timeline (what goes when), voxels (.binvox), "
                  "stock (left over, .binvox), surface (as milling tools leave it, .ply with the excess of each "
                  "vertex), residue (ndjson), report (json) or program (for a controller, .zip)")
      ->check(CLI::IsMember(artifact_names))
      ->capture_default_str();
  add_program_options(command, options->program);
}

void add_link(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<LinkOptions>();
  CLI::App& command =
      add_command(app, invocation, "link",
                  "Print a URL at which whoever has it can read a result for five minutes: for players, "
                  "viewers and plain downloads, which send no token",
                  [&invocation, options] { return run_link(invocation.server, *options); });
  command.add_option("job", options->job, "The id that submit printed")->type_name("JOB")->required();
  command.add_option("--artifact", options->artifact, "As of fetch")
      ->check(CLI::IsMember(artifact_names))
      ->capture_default_str();
  command.add_option("--format", options->format, "As of fetch")->check(CLI::IsMember(format_names));
  add_program_options(command, options->program);
  command.add_flag("--json", options->json, "Print {job, artifact, path, url, expires_at} as one JSON document");
}

}  // namespace sculpt::cli
