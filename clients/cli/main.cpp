// sculpt: the command-line client of sculptd. One file per command.
#include <cstdlib>
#include <iostream>
#include <new>

#include "clients/cli/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cpp/client.hpp"
#include "core/base/watch.hpp"

namespace {

int complain(int exit_code, const std::string& code, const std::string& sentence) {
  std::cout.flush();
  std::cerr << "sculpt: " << code << ": " << sentence << "\n";
  return exit_code;
}

/// Runs the command; whatever it throws becomes a line on stderr and an exit code.
int run(const sculpt::Invocation& invocation) try { return invocation.run(); } catch (const sculpt::Failure& failure) {
  return complain(failure.exit_code(), failure.code(), failure.what());
} catch (const sculpt::ServerUnreachable& error) {
  return complain(sculpt::exit_unreachable, "unreachable", error.what());
} catch (const sculpt::ServerError& error) {
  const bool damaged = error.code() == "artifact_damaged";
  return complain(damaged ? sculpt::exit_failed : sculpt::exit_refused, error.code(), error.what());
} catch (const sculpt::InputError& error) {
  return complain(sculpt::exit_refused, error.code(), error.what());
} catch (const sculpt::Cancelled&) {
  return complain(sculpt::exit_failed, "cancelled", "interrupted: nothing was written");
} catch (const std::bad_alloc&) {
  return complain(sculpt::exit_failed, "out_of_memory", "not enough memory: lower --resolution or use a smaller mesh");
} catch (const std::exception& error) {
  return complain(sculpt::exit_failed, "internal_error", error.what());
}

}  // namespace

int main(int argc, char** argv) {
  const char* named = std::getenv("SCULPT_SERVER");
  sculpt::Invocation invocation{named != nullptr && *named != '\0' ? named : "127.0.0.1:7878", {}};
  CLI::App app{"Plans robot carving: turns a mesh into a checked, collision-free joint trajectory", "sculpt"};
  sculpt::add_common_options(app, invocation);
  app.require_subcommand(1);
  sculpt::add_submit(app, invocation);
  sculpt::add_list(app, invocation);
  sculpt::add_status(app, invocation);
  sculpt::add_top(app, invocation);
  sculpt::add_watch(app, invocation);
  sculpt::add_wait(app, invocation);
  sculpt::add_cancel(app, invocation);
  sculpt::add_pause(app, invocation);
  sculpt::add_resume(app, invocation);
  sculpt::add_retry(app, invocation);
  sculpt::add_pin(app, invocation);
  sculpt::add_queue(app, invocation);
  sculpt::add_report(app, invocation);
  sculpt::add_fetch(app, invocation);
  sculpt::add_verify(app, invocation);
  sculpt::add_voxelize(app, invocation);
  sculpt::add_plan(app, invocation);
  sculpt::add_completion(app, invocation);
  app.footer(
      "Exit codes: 0 fine, 1 the job failed or the check found something, 2 usage, 3 server unreachable, 4 refused.\n"
      "sculpt COMMAND --help says more about each command.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return complain(sculpt::exit_usage, "usage", std::string(error.what()) + " (see sculpt COMMAND --help)");
  }
  return run(invocation);
}
