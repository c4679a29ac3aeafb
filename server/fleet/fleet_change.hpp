// One change of the store of a fleet: a transaction, and the rules for jobs over its rows.
#pragma once

#include "server/fleet/fleet_rows.hpp"
#include "server/store/job_store.hpp"
#include "server/store/job_table.hpp"

namespace sculpt::server {

/// Undone unless committed. Belongs to the thread that has the connection.
struct FleetChange {
  /// Refers to all of them.
  FleetChange(Postgres& database, const FleetRows::Lease& lease, const StoreRules& rules)
      : transaction(database),
        rows(transaction, lease),
        jobs(rows, [this, &rules] { return rules.now_ms ? rules.now_ms() : transaction.now_ms(); }) {}
  FleetChange(const FleetChange&) = delete;
  FleetChange& operator=(const FleetChange&) = delete;

  /// Tells the others, and gives the numbers of the events. Throws as PostgresChange::commit.
  std::vector<std::uint64_t> commit(Histogram& times) {
    transaction.later({"NOTIFY sculptd"});
    std::vector<std::uint64_t> numbers;
    // Events are the one thing that is inserted with an answer.
    for (const Answered& answer : transaction.commit(times))
      if (answer.is("INSERT") && answer.rows() == 1) numbers.push_back(static_cast<std::uint64_t>(answer.number(0, 0)));
    return numbers;
  }

  PostgresChange transaction;
  FleetRows rows;
  JobTable jobs;
};

}  // namespace sculpt::server
