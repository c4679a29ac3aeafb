// The tables of the job store, and how those of older versions become today's.
#pragma once

#include "server/store/sqlite/sqlite.hpp"

namespace sculpt::server {

inline constexpr std::int64_t schema_version = 6;

/// In one transaction; does nothing to a database that is up to date. Throws StorageError for one that is newer.
void update_schema(Database& database, const std::filesystem::path& file);

}  // namespace sculpt::server
