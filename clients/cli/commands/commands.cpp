#include "clients/cli/commands/commands.hpp"

#include <algorithm>
#include <cctype>
#include <iostream>

#include "proto/version.hpp"

namespace sculpt::cli {

namespace {

const CLI::Validator address{
    [](std::string& text) {
      if (text.rfind("unix:", 0) == 0) return std::string();
      const std::size_t colon = text.rfind(':');
      const std::string port = colon == std::string::npos ? "" : text.substr(colon + 1);
      const bool digits = std::all_of(port.begin(), port.end(), [](unsigned char c) { return std::isdigit(c); });
      const bool usable = colon > 0 && !port.empty() && port.size() <= 5 && digits && std::stoi(port) <= 65535;
      return usable ? std::string()
                    : "'" + text +
                          "' is no address: write HOST:PORT, tls:HOST:PORT or unix:PATH, for example 127.0.0.1:7878";
    },
    ""};

}  // namespace

client::Client connect(const std::string& server) {
  client::Client client(server, proto::client_name);
  client.when_lost([](const std::string& sentence) { std::cerr << "sculpt: " << sentence << std::endl; });
  return client;
}

void add_common_options(CLI::App& command, Invocation& invocation) {
  command
      .add_option("--server", invocation.server,
                  "Where sculptd listens: HOST:PORT, tls:HOST:PORT or unix:PATH (env SCULPT_SERVER)")
      ->type_name("ADDRESS")
      ->check(address)
      ->capture_default_str();
  command.set_version_flag("--version", proto::client_name);
}

CLI::App& add_command(CLI::App& app, Invocation& invocation, const std::string& name, const std::string& description,
                      std::function<int()> run) {
  CLI::App& command = *app.add_subcommand(name, description);
  add_common_options(command, invocation);
  command.final_callback([&invocation, run = std::move(run)] { invocation.run = run; });
  return command;
}

}  // namespace sculpt::cli
