#include "clients/cli/commands.hpp"

namespace sculpt {

void add_common_options(CLI::App& command, Invocation& invocation) {
  command.add_option("--server", invocation.server, "Where sculptd listens (env SCULPT_SERVER)")
      ->type_name("HOST:PORT")
      ->capture_default_str();
  command.set_version_flag("--version", client_name);
}

CLI::App& add_command(CLI::App& app, Invocation& invocation, const std::string& name, const std::string& description,
                      std::function<int()> run) {
  CLI::App& command = *app.add_subcommand(name, description);
  add_common_options(command, invocation);
  command.final_callback([&invocation, run = std::move(run)] { invocation.run = run; });
  return command;
}

}  // namespace sculpt
