// fsck: what the store says, against itself.
#include <algorithm>
#include <iterator>

#include "server/ops/fsck.hpp"
#include "server/store/job_store.hpp"
#include "server/store/sqlite/sqlite.hpp"

namespace sculpt::server {
namespace {

constexpr const char* restore = "restore a backup of the data folder";

std::vector<Fault> find_damage(Database& database) {
  std::vector<Fault> faults;
  Statement whole(database, "PRAGMA integrity_check(20)");
  while (whole.step())
    if (whole.text(0) != "ok") faults.push_back({"the database: " + whole.text(0), restore});
  Statement keys(database, "PRAGMA foreign_key_check");
  while (keys.step()) faults.push_back({"the database: a row of " + keys.text(0) + " belongs to no job", restore});
  return faults;
}

std::vector<Fault> find_gaps(Database& database) {
  std::vector<Fault> faults;
  Statement query(database,
                  "SELECT job.id, job.state, count(event.seq), min(event.seq), max(event.seq), "
                  "(SELECT state FROM event AS last WHERE last.job = job.number ORDER BY seq DESC LIMIT 1) "
                  "FROM job LEFT JOIN event ON event.job = job.number GROUP BY job.number ORDER BY job.number");
  while (query.step()) {
    const std::string job = "job " + query.text(0), state = query.text(1);
    if (!find_state(state)) faults.push_back({job + ": its state '" + state + "' is none", restore});
    if (query.number(3) != 1 || query.number(2) != query.number(4))
      faults.push_back({job + ": its events are not numbered 1, 2, 3 without a gap", restore});
    else if (query.text(5) != state)
      faults.push_back({job + ": it is " + state + ", but its last event says " + query.text(5), restore});
  }
  return faults;
}

}  // namespace

std::vector<Fault> find_store_faults(Database& database) {
  std::vector<Fault> faults = find_damage(database);
  std::ranges::move(find_gaps(database), std::back_inserter(faults));
  return faults;
}

}  // namespace sculpt::server
