// The store of a test: SQLite, or where the test runs beside a PostgreSQL (tests/fleet/with_postgres) a database there.
// So every test of what a store does says it of both.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

#include "server/fleet/fleet_store.hpp"
#include "server/store/job_store.hpp"

namespace sculpt::server {

/// The tests of this process are about stores in PostgreSQL.
bool test_in_postgres();

/// A store that a daemon of this name shares; the same for the same file, and fresh for one that this test has not
/// named before.
std::unique_ptr<FleetStore> open_test_fleet(const std::filesystem::path& file, StoreRules rules = {},
                                            const std::string& daemon = "tester",
                                            std::chrono::milliseconds lease = std::chrono::seconds(30));
/// The address of the database behind it.
std::string test_database(const std::filesystem::path& file);

/// Either of the two.
std::unique_ptr<JobStore> open_test_store(const std::filesystem::path& file, StoreRules rules = {});

}  // namespace sculpt::server

/// For what only a file of SQLite can show.
#define SCULPT_SQLITE_ONLY() \
  if (sculpt::server::test_in_postgres()) GTEST_SKIP() << "this looks into the file of SQLite"
/// For what needs a PostgreSQL.
#define SCULPT_POSTGRES_ONLY() \
  if (!sculpt::server::test_in_postgres()) GTEST_SKIP() << "no PostgreSQL: tests/fleet/with_postgres test_server"
