// The tables of the job store in PostgreSQL, and how those of older versions become today's.
#pragma once

#include <cstdint>

#include "server/fleet/postgres.hpp"

namespace sculpt::server {

inline constexpr std::int64_t fleet_schema_version = 2;

/// The keys of the locks that all daemons of a database share.
enum class FleetLock : std::int64_t {
  schema = 0x5c01'0001,  ///< who brings the tables up to date
  events = 0x5c01'0002,  ///< from the number of an event to its commit: so they are seen in order and without a gap
  sweep = 0x5c01'0003    ///< held by the one daemon that removes old jobs and files
};
SqlValue sql_value(FleetLock lock);

/// In one transaction, under a lock; does nothing to tables that are up to date. May take minutes. Throws StorageError
/// for newer ones, and where the role may not make tables; DatabaseUnavailable where somebody else keeps a table.
void update_fleet_schema(const PostgresSource& source);

/// Lets a role that is there do what a daemon does with the tables, and no more. Throws StorageError.
void grant_to_daemons(const PostgresSource& source, const std::string& role);

}  // namespace sculpt::server
