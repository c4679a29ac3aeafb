// sculptd adopt, fsck: the operator's side of a data folder that no daemon uses.
#pragma once

#include <iosfwd>

namespace CLI {
class App;
}

namespace sculpt::server {

struct Config;

struct FolderCommand {
  enum class Verb { none, adopt, fsck };
  Verb verb = Verb::none;
  bool repair = false;
};

void add_folder_command(CLI::App& app, FolderCommand& command);

/// Prints what was done or found, and gives the exit code. Throws DataFolderError, StoreLost, StorageError.
int run_folder_command(const FolderCommand& command, const Config& config, std::ostream& out);

}  // namespace sculpt::server
