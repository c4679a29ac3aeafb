// sculptd migrate: brings the tables of a fleet's database up to date, as their owner, so that daemons need no right
// to.
#pragma once

#include <iosfwd>
#include <string>

namespace CLI {
class App;
}

namespace sculpt::server {

struct Config;

struct MigrateCommand {
  bool wanted = false;
  std::string daemon_role;  ///< that may use the tables from then on; empty: nobody new
};

void add_migrate_command(CLI::App& app, MigrateCommand& command);

/// Prints what was done. Throws ConfigError (no such store is named), StorageError.
void run_migrate_command(const MigrateCommand& command, const Config& config, std::ostream& out);

}  // namespace sculpt::server
