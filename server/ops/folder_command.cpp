#include "server/ops/folder_command.hpp"

#include <CLI/CLI.hpp>
#include <ostream>

#include "server/base/config.hpp"
#include "server/ops/fsck.hpp"
#include "server/ops/store_opening.hpp"

namespace sculpt::server {

void add_folder_command(CLI::App& app, FolderCommand& command) {
  using Verb = FolderCommand::Verb;
  CLI::App* adopt = app.add_subcommand("adopt",
                                       "Take the data folder as it is, after the daemon refused it: go on with "
                                       "the jobs that are still known");
  adopt->fallthrough()->callback([&command] { command.verb = Verb::adopt; });
  CLI::App* fsck = app.add_subcommand("fsck", "Look at everything in the data folder of a daemon that does not run");
  fsck->add_flag("--repair", command.repair, "Repair what can be");
  fsck->fallthrough()->callback([&command] { command.verb = Verb::fsck; });
}

int run_folder_command(const FolderCommand& command, const Config& config, std::ostream& out) {
  if (!config.store.empty()) {
    throw ConfigError("fsck and adopt look at a data folder with its own database, and the store is " +
                      without_password(config.store) + ": leave store out to look at the folder");
  }
  if (command.verb == FolderCommand::Verb::fsck) return run_fsck({config.data}, command.repair, out);
  const DataFolder folder(config.data);
  for (const std::string& sentence : adopt_store(folder)) out << sentence << "\n";
  return EXIT_SUCCESS;
}

}  // namespace sculpt::server
