// The job store in PostgreSQL, which any number of daemons share (docs/fleet.md).
#pragma once

#include <chrono>
#include <memory>
#include <vector>

#include "server/files/shared_files.hpp"
#include "server/fleet/fleet_member.hpp"
#include "server/fleet/postgres.hpp"
#include "server/store/job_store.hpp"

namespace sculpt::server {

struct FleetRules {
  PostgresSource source;
  FleetMember member;
  std::chrono::milliseconds lease{30000};  ///< a daemon that is silent for so long has lost its jobs
  bool keeps_files = false;                ///< files are in the database too, not in a folder of all daemons
};

/// As JobStore says, with these differences. Time is the database's. The bound of memory, and the one suspect at a
/// time, are each daemon's own: a job that this daemon never has room for is left to one that has. `recover` releases
/// what this daemon held, and `wake_due` also what daemons held whose lease is over. `counts` and `position` are as of
/// the last look, a second ago at most, but know all that was done here. Every method throws DatabaseUnavailable when
/// the database cannot be reached; after it nothing was done, unless the connection broke at the commit: then a
/// submit with a key, a finish, a release and what an operator says can be repeated without harm.
class FleetStore : public JobStore {
 public:
  /// From now on the others know this daemon by its address (HOST:PORT, for people), leases are renewed and others'
  /// changes are followed, on threads of the store.
  virtual void join(const std::string& address, FleetHooks hooks) = 0;
  /// Ends that. Call when no job runs here any more.
  virtual void leave() = 0;

  /// What all daemons have agreed upon under this name: the value of the one that came first.
  virtual std::string settle(const std::string& name, const std::string& value) = 0;
  /// Null where they are in a folder.
  virtual SharedFiles* files() = 0;
  /// The database's wall time, as of the last renewal of leases and what has passed since by this machine's clock.
  virtual std::uint64_t now_ms() const = 0;
  virtual std::vector<FleetDaemon> daemons() = 0;
  /// Of a job that any daemon runs, as of the last look.
  virtual std::optional<Progress> progress(const std::string& job) = 0;
  /// This daemon is the one that removes what is old.
  virtual bool sweeps() const = 0;
  /// Why this daemon takes no jobs though the queue may have some; empty: it takes them.
  virtual std::string why_idle() const = 0;

  // Counted since the start.
  virtual std::uint64_t leases_lost() const = 0;
  /// Ends of runs that came when the job was another's.
  virtual std::uint64_t late_ends() const = 0;
  virtual DatabaseFigures figures() const = 0;
};

/// Brings the tables up to date first. Throws StorageError (unreachable, made by a newer version, no rights).
std::unique_ptr<FleetStore> open_fleet_store(FleetRules fleet, StoreRules rules = {});

}  // namespace sculpt::server
