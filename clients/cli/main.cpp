// sculpt: the command-line client of sculptd. One file per command.
#include <cstdlib>
#include <iostream>
#include <new>

#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cpp/client.hpp"
#include "core/base/watch.hpp"

namespace {

namespace cli = sculpt::cli;
namespace client = sculpt::client;

int complain(int exit_code, const std::string& code, const std::string& sentence) {
  std::cout.flush();
  std::cerr << "sculpt: " << code << ": " << sentence << "\n";
  return exit_code;
}

/// Runs the command; whatever it throws becomes a line on stderr and an exit code.
int run(const cli::Invocation& invocation) try { return invocation.run(); } catch (const cli::Failure& failure) {
  return complain(failure.exit_code(), failure.code(), failure.what());
} catch (const client::ServerUnreachable& error) {
  return complain(cli::exit_unreachable, "unreachable", error.what());
} catch (const client::ServerError& error) {
  const bool damaged = error.code() == "artifact_damaged";
  return complain(damaged ? cli::exit_failed : cli::exit_refused, error.code(), error.what());
} catch (const sculpt::InputError& error) {
  return complain(cli::exit_refused, error.code(), error.what());
} catch (const sculpt::Cancelled&) {
  return complain(cli::exit_failed, "cancelled", "interrupted: nothing was written");
} catch (const std::bad_alloc&) {
  return complain(cli::exit_failed, "out_of_memory", "not enough memory: lower --resolution or use a smaller mesh");
} catch (const std::exception& error) {
  return complain(cli::exit_failed, "internal_error", error.what());
}

}  // namespace

int main(int argc, char** argv) {
  const char* named = std::getenv("SCULPT_SERVER");
  cli::Invocation invocation{named != nullptr && *named != '\0' ? named : "127.0.0.1:7878", {}};
  CLI::App app{"Plans robot carving: turns a mesh into a checked, collision-free joint trajectory", "sculpt"};
  cli::add_common_options(app, invocation);
  app.require_subcommand(1);
  cli::add_submit(app, invocation);
  cli::add_list(app, invocation);
  cli::add_status(app, invocation);
  cli::add_top(app, invocation);
  cli::add_watch(app, invocation);
  cli::add_wait(app, invocation);
  cli::add_cancel(app, invocation);
  cli::add_pause(app, invocation);
  cli::add_resume(app, invocation);
  cli::add_retry(app, invocation);
  cli::add_pin(app, invocation);
  cli::add_queue(app, invocation);
  cli::add_report(app, invocation);
  cli::add_fetch(app, invocation);
  cli::add_link(app, invocation);
  cli::add_render(app, invocation);
  cli::add_verify(app, invocation);
  cli::add_voxelize(app, invocation);
  cli::add_plan(app, invocation);
  cli::add_cell(app, invocation);
  cli::add_place(app, invocation);
  cli::add_time(app, invocation);
  cli::add_sample(app, invocation);
  cli::add_program(app, invocation);
  cli::add_completion(app, invocation);
  app.footer(
      "Exit codes: 0 fine, 1 the job failed or the check found something, 2 usage, 3 server unreachable, 4 refused.\n"
      "sculpt COMMAND --help says more about each command.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return complain(cli::exit_usage, "usage", std::string(error.what()) + " (see sculpt COMMAND --help)");
  }
  return run(invocation);
}
