// sculpt list, status: one question, one answer.
#include <cstdio>
#include <iostream>
#include <memory>

#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cpp/client.hpp"

namespace sculpt::cli {

namespace {

struct JobArgument {
  std::string job;
  bool json = false;
};

struct ListOptions {
  bool newest = false, json = false;
  std::size_t limit = 0;
};

std::string text_or_dash(const Json& object, const char* field) {
  if (!object.contains(field)) return "-";
  const Json& value = object[field];
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string progress_of(const Json& job) {
  if (!job.contains("progress")) return "";
  const Json& progress = job["progress"];
  return text_or_dash(progress, "stage") + " " + text_or_dash(progress, "done") + "/" + text_or_dash(progress, "total");
}

int run_list(const std::string& server, const ListOptions& options) {
  client::Client client = connect(server);
  const Json found = client.list({.newest = options.newest, .limit = options.limit});
  const Json& jobs = found.at("jobs");
  for (const Json& job : found.value("damaged", Json::array()))
    std::cerr << "sculpt: warning: " << text_or_dash(job, "job") << " is left out: " << text_or_dash(job, "message")
              << "\n";
  if (options.json) {
    std::cout << proto::write_json({{"jobs", jobs}}) << "\n";
    return exit_fine;
  }
  std::printf("%-26s  %-11s  %-24s  %5s  %-16s  %s\n", "JOB", "STATE", "MESH", "N", "ROBOT", "SUBMITTED");
  for (const Json& job : jobs)
    std::printf("%-26s  %-11s  %-24s  %5s  %-16s  %s  %s\n", text_or_dash(job, "job").c_str(),
                text_or_dash(job, "state").c_str(), text_or_dash(job, "mesh").c_str(),
                text_or_dash(job, "resolution").c_str(), text_or_dash(job, "robot").c_str(),
                text_or_dash(job, "submitted_at").c_str(), progress_of(job).c_str());
  return exit_fine;
}

void print_status(const Json& job) {
  for (const auto& [field, value] : job.items()) {
    if (value.is_object()) continue;
    std::printf("%-14s%s\n", field.c_str(), text_or_dash(job, field.c_str()).c_str());
  }
  if (job.contains("progress")) std::printf("%-14s%s\n", "progress", progress_of(job).c_str());
  if (job.contains("error"))
    std::printf("%-14s%s: %s\n", "error", text_or_dash(job["error"], "code").c_str(),
                text_or_dash(job["error"], "message").c_str());
}

int run_status(const std::string& server, const JobArgument& options) {
  client::Client client = connect(server);
  const Json job = client.call("job.get", {{"job", options.job}});
  if (options.json)
    std::cout << proto::write_json(job) << "\n";
  else
    print_status(job);
  return exit_fine;
}

}  // namespace

void add_list(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<ListOptions>();
  CLI::App& command = add_command(app, invocation, "list", "The jobs of the server, in the order of submission",
                                  [&invocation, options] { return run_list(invocation.server, *options); });
  command.add_flag("--newest", options->newest, "The newest first");
  command.add_option("--limit", options->limit, "Only so many")->type_name("N")->check(CLI::PositiveNumber);
  command.add_flag("--json", options->json, "Print {jobs: [...]} as one JSON document");
}

void add_status(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<JobArgument>();
  CLI::App& command = add_command(app, invocation, "status", "What a job is and how far it has come",
                                  [&invocation, options] { return run_status(invocation.server, *options); });
  command.add_option("job", options->job, "The id that submit printed")->type_name("JOB")->required();
  command.add_flag("--json", options->json, "Print the job as one JSON document");
}

}  // namespace sculpt::cli
