// sculpt watch, wait: until the job ends, with and without a word.
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <memory>

#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cli/interrupt.hpp"
#include "clients/cli/job_end.hpp"

namespace sculpt::cli {

namespace {

struct WatchOptions {
  std::string job;
  bool json = false;
};

int run_watch(const std::string& server, const WatchOptions& options) {
  const Interrupt interrupt([&options] {
    std::cerr << "\nsculpt: interrupted: job " << options.job << " goes on; see it again with: sculpt watch "
              << options.job << "\n";
    std::_Exit(exit_failed);
  });
  client::Client client = connect(server);
  ProgressLine progress(options.json ? STDERR_FILENO : STDOUT_FILENO,
                        options.json ? PlainLines::none : PlainLines::on_change);
  const Json end = follow_job(client, options.job, progress);
  if (options.json) std::cout << proto::write_json(end) << "\n";
  return end_exit_code(end);
}

int run_wait(const std::string& server, const WatchOptions& options) {
  client::Client client = connect(server);
  const Json end = wait_job(client, options.job);
  if (options.json) std::cout << proto::write_json(end) << "\n";
  return end_exit_code(end);
}

}  // namespace

void add_watch(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<WatchOptions>();
  CLI::App& command =
      add_command(app, invocation, "watch",
                  "Show a job live until it ends: a bar on a terminal, else lines; Ctrl-C leaves the job running",
                  [&invocation, options] { return run_watch(invocation.server, *options); });
  command.add_option("job", options->job, "The id that submit printed")->type_name("JOB")->required();
  command.add_flag("--json", options->json, "Print the ended job as one JSON document, the bar on stderr");
}

void add_wait(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<WatchOptions>();
  CLI::App& command = add_command(app, invocation, "wait", "Return when a job has ended; exit 0 only if it succeeded",
                                  [&invocation, options] { return run_wait(invocation.server, *options); });
  command.add_option("job", options->job, "The id that submit printed")->type_name("JOB")->required();
  command.add_flag("--json", options->json, "Print the ended job as one JSON document");
}

}  // namespace sculpt::cli
