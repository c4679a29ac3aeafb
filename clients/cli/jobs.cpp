// sculpt list, status: one question, one answer.
#include <cstdio>
#include <iostream>
#include <memory>

#include "clients/cli/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cpp/client.hpp"

namespace sculpt {

namespace {

struct JobArgument {
  std::string job;
  bool json = false;
};

std::string text_of(const Json& object, const char* field) {
  if (!object.contains(field)) return "-";
  const Json& value = object[field];
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string progress_of(const Json& job) {
  if (!job.contains("progress")) return "";
  const Json& progress = job["progress"];
  return text_of(progress, "stage") + " " + text_of(progress, "done") + "/" + text_of(progress, "total");
}

Json all_jobs(Client& client) {
  Json jobs = Json::array();
  for (bool more = true; more;) {
    Json params{{"limit", 1000}};
    if (!jobs.empty()) params["after"] = jobs.back().at("job");
    const Json page = client.call("job.list", params);
    for (const Json& job : page.at("jobs")) jobs.push_back(job);
    more = page.value("more", false) && !page.at("jobs").empty();
  }
  return jobs;
}

int run_list(const std::string& server, bool json) {
  Client client = connect(server);
  const Json jobs = all_jobs(client);
  if (json) {
    std::cout << write_json({{"jobs", jobs}}) << "\n";
    return exit_fine;
  }
  std::printf("%-26s  %-11s  %-24s  %5s  %-16s  %s\n", "JOB", "STATE", "MESH", "N", "ROBOT", "SUBMITTED");
  for (const Json& job : jobs)
    std::printf("%-26s  %-11s  %-24s  %5s  %-16s  %s  %s\n", text_of(job, "job").c_str(), text_of(job, "state").c_str(),
                text_of(job, "mesh").c_str(), text_of(job, "resolution").c_str(), text_of(job, "robot").c_str(),
                text_of(job, "submitted_at").c_str(), progress_of(job).c_str());
  return exit_fine;
}

void print_status(const Json& job) {
  for (const auto& [field, value] : job.items()) {
    if (value.is_object()) continue;
    std::printf("%-14s%s\n", field.c_str(), text_of(job, field.c_str()).c_str());
  }
  if (job.contains("progress")) std::printf("%-14s%s\n", "progress", progress_of(job).c_str());
  if (job.contains("error"))
    std::printf("%-14s%s: %s\n", "error", text_of(job["error"], "code").c_str(),
                text_of(job["error"], "message").c_str());
}

int run_status(const std::string& server, const JobArgument& options) {
  Client client = connect(server);
  const Json job = client.call("job.get", {{"job", options.job}});
  if (options.json)
    std::cout << write_json(job) << "\n";
  else
    print_status(job);
  return exit_fine;
}

}  // namespace

void add_list(CLI::App& app, Invocation& invocation) {
  const auto json = std::make_shared<bool>(false);
  CLI::App& command = add_command(app, invocation, "list", "All jobs of the server, in the order of submission",
                                  [&invocation, json] { return run_list(invocation.server, *json); });
  command.add_flag("--json", *json, "Print {jobs: [...]} as one JSON document");
}

void add_status(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<JobArgument>();
  CLI::App& command = add_command(app, invocation, "status", "What a job is and how far it has come",
                                  [&invocation, options] { return run_status(invocation.server, *options); });
  command.add_option("job", options->job, "The id that submit printed")->type_name("JOB")->required();
  command.add_flag("--json", options->json, "Print the job as one JSON document");
}

}  // namespace sculpt
