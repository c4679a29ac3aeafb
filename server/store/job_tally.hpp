// How many jobs are in which state, and the order of the queued ones: counted at every change, so that no question
// about them reads rows.
#pragma once

#include <cstdint>
#include <ext/pb_ds/assoc_container.hpp>
#include <ext/pb_ds/tree_policy.hpp>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/store/job_state.hpp"

namespace sculpt::server {

/// A job came (no `from`), changed its state, or went (no `to`).
struct TallyMove {
  std::int64_t rank = 0;
  std::string id, owner, queue;
  std::optional<JobState> from, to;
};

/// Safe from any thread.
class JobTally {
 public:
  void apply(const std::vector<TallyMove>& moves);
  /// With an entry for each state.
  std::map<JobState, std::uint64_t> counts() const;
  /// Jobs that have not ended: of everybody where no owner is given.
  std::uint64_t open(const std::string& owner = {}) const;
  /// Of the job that is first in this queue; nothing if none is queued.
  std::optional<std::int64_t> first_rank(const std::string& queue) const;
  /// How many jobs of this queue come before this one, in O(log n).
  std::uint64_t position(const std::string& queue, std::int64_t rank, const std::string& id) const;

 private:
  using Place = std::pair<std::int64_t, std::string>;
  using Queue = __gnu_pbds::tree<Place, __gnu_pbds::null_type, std::less<>, __gnu_pbds::rb_tree_tag,
                                 __gnu_pbds::tree_order_statistics_node_update>;

  void enter(const TallyMove& move, JobState state);
  void leave(const TallyMove& move, JobState state);

  mutable std::mutex mutex_;
  std::map<JobState, std::uint64_t> counts_;
  std::map<std::string, std::uint64_t> open_by_owner_;  // of owners with a name that have some
  std::map<std::string, Queue> queues_;                 // that have jobs
};

}  // namespace sculpt::server
