// The daemon's place in a fleet: who it is, the database that it shares, and the folder of results that all of them
// reach.
#pragma once

#include <memory>
#include <string>

#include "server/base/config.hpp"
#include "server/files/data_folder.hpp"
#include "server/fleet/fleet_store.hpp"

namespace sculpt::server {

/// Throws ConfigError where the setting `store` names no PostgreSQL.
void check_store_address(const Config& config);

/// With the setting `shared` uploads and results are in that folder, without it in the database.
/// Makes what is missing of the folder; its first daemon writes into it which store it belongs to. Throws
/// ConfigError (a setting is missing, or is none), DataFolderError, StoreLost (the folder belongs to another store),
/// StorageError.
std::unique_ptr<FleetStore> open_fleet(const Config& config, const FolderPaths& own, int workers, StoreRules rules);

/// What links are signed with: where several daemons answer, one's are good at all. Without a fleet it is this daemon's
/// own, until it ends.
std::string link_secret(FleetStore* fleet);

}  // namespace sculpt::server
