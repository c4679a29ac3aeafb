// Which job of the fleet's queue a daemon takes next, and what time alone changes.
#pragma once

#include <atomic>

#include "server/fleet/fleet_change.hpp"
#include "server/fleet/fleet_member.hpp"

namespace sculpt::server {

/// What a daemon has in mind when it looks for a job.
struct Claimant {
  AtWork at_work;
  /// Knows which rank is the first that is queued, if any is known. While somebody holds a transaction open the rows of
  /// all jobs since are passed on the way to it: this leads around them.
  const JobTally& tally;
};

/// Locks the row until the change ends; rows that others are looking at are passed over. Nothing where JobStore::claim
/// gives nothing, and where the tables are of a newer version than this program knows: then `newer_schema` is set to
/// that, and the log says it once.
std::optional<JobRow> next_job(FleetChange& change, const Claimant& claimant, const StoreRules& rules,
                               std::atomic<std::int64_t>& newer_schema);

/// One cheap question. `at_work`: FleetFeed::at_work.
bool is_anything_due(Postgres& database, const StoreRules& rules, const SqlValue& at_work);
/// As JobStore::wake_due; also, of those at work the runs whose lease is over are taken from their daemons. Gives the
/// jobs that changed.
std::vector<std::string> change_due(FleetChange& change, const SqlValue& at_work);

/// For people: why a daemon takes no jobs when the tables are of this version; empty for those that it knows.
std::string schema_too_new(std::int64_t version);

}  // namespace sculpt::server
