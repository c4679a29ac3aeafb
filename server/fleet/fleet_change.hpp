// One change of the store of a fleet: a transaction, and the rules for jobs over its rows.
#pragma once

#include "server/fleet/fleet_feed.hpp"
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

  /// Tells the others; what this change and others did meanwhile is counted in `feed`. Throws as
  /// PostgresChange::commit.
  void commit(Histogram& times, FleetFeed& feed) {
    transaction.later({"NOTIFY sculptd"});
    const std::vector<Answered> answers = transaction.commit(times, feed.questions());
    std::vector<std::uint64_t> numbers;
    // Events are the one thing that is inserted with an answer.
    for (const Answered& answer : answers)
      if (answer.is("INSERT") && answer.rows() == 1) numbers.push_back(static_cast<std::uint64_t>(answer.number(0, 0)));
    feed.made_here(numbers);
    feed.take(answers[answers.size() - 2], answers.back());
  }

  PostgresChange transaction;
  FleetRows rows;
  JobTable jobs;
};

}  // namespace sculpt::server
