#include "server/ops/migrate_command.hpp"

#include <CLI/CLI.hpp>
#include <ostream>

#include "server/base/config.hpp"
#include "server/fleet/fleet_schema.hpp"
#include "server/ops/fleet_opening.hpp"

namespace sculpt::server {

void add_migrate_command(CLI::App& app, MigrateCommand& command) {
  CLI::App* migrate = app.add_subcommand("migrate",
                                         "Make the tables of the store that daemons share, or bring them up "
                                         "to date, as the role that store names");
  migrate->add_option("--daemon-role", command.daemon_role, "Let this role use them, as a daemon has to")
      ->type_name("ROLE");
  migrate->callback([&command] { command.wanted = true; });
}

void run_migrate_command(const MigrateCommand& command, const Config& config, std::ostream& out) {
  check_store_address(config);
  const PostgresSource source{config.store, config.store_password_file};
  update_fleet_schema(source);
  out << "the tables are of version " << fleet_schema_version << "\n";
  if (command.daemon_role.empty()) return;
  grant_to_daemons(source, command.daemon_role);
  out << "the role '" << command.daemon_role << "' may use them\n";
}

}  // namespace sculpt::server
