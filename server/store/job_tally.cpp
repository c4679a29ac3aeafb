#include "server/store/job_tally.hpp"

namespace sculpt::server {

void JobTally::apply(const std::vector<TallyMove>& moves) {
  const std::lock_guard lock(mutex_);
  for (const TallyMove& move : moves) {
    if (move.from) leave(move, *move.from);
    if (move.to) enter(move, *move.to);
  }
}

void JobTally::enter(const TallyMove& move, JobState state) {
  ++counts_[state];
  if (state == JobState::queued) queues_[move.queue].insert({move.rank, move.id});
  if (!is_final(state) && !move.owner.empty()) ++open_by_owner_[move.owner];
}

void JobTally::leave(const TallyMove& move, JobState state) {
  --counts_[state];
  if (const auto queue = queues_.find(move.queue); state == JobState::queued && queue != queues_.end()) {
    queue->second.erase({move.rank, move.id});
    if (queue->second.empty()) queues_.erase(queue);
  }
  if (is_final(state) || move.owner.empty()) return;
  const auto open = open_by_owner_.find(move.owner);
  if (--open->second == 0) open_by_owner_.erase(open);
}

std::map<JobState, std::uint64_t> JobTally::counts() const {
  const std::lock_guard lock(mutex_);
  std::map<JobState, std::uint64_t> counts = counts_;
  for (const JobState state : job_states) counts.try_emplace(state, 0);
  return counts;
}

std::uint64_t JobTally::open(const std::string& owner) const {
  const std::lock_guard lock(mutex_);
  if (!owner.empty()) {
    const auto found = open_by_owner_.find(owner);
    return found == open_by_owner_.end() ? 0 : found->second;
  }
  std::uint64_t open = 0;
  for (const auto& [state, count] : counts_) open += is_final(state) ? 0 : count;
  return open;
}

std::optional<std::int64_t> JobTally::first_rank(const std::string& queue) const {
  const std::lock_guard lock(mutex_);
  const auto found = queues_.find(queue);
  return found == queues_.end() ? std::nullopt : std::optional(found->second.begin()->first);
}

std::uint64_t JobTally::position(const std::string& queue, std::int64_t rank, const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto found = queues_.find(queue);
  return found == queues_.end() ? 0 : found->second.order_of_key({rank, id});
}

}  // namespace sculpt::server
