#include "server/store/job_tally.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.hpp"

namespace sculpt::server {
namespace {

constexpr std::uint64_t seeds = 20;
constexpr int steps = 400;

struct Counted {
  std::int64_t rank;
  std::string id, owner, queue;
  JobState state;
};

bool comes_before(const Counted& a, const Counted& b) {
  return a.rank != b.rank ? a.rank < b.rank : a.id < b.id;
}

std::uint64_t count_if(const std::vector<Counted>& jobs, const std::function<bool(const Counted&)>& is_one) {
  return static_cast<std::uint64_t>(std::ranges::count_if(jobs, is_one));
}

void compare(const JobTally& tally, const std::vector<Counted>& jobs) {
  for (const JobState state : job_states)
    ASSERT_EQ(tally.counts().at(state), count_if(jobs, [&](const Counted& job) { return job.state == state; }));
  ASSERT_EQ(tally.open(), count_if(jobs, [](const Counted& job) { return !is_final(job.state); }));
  for (const std::string owner : {"arm", "gantry", "nobody"}) {
    ASSERT_EQ(tally.open(owner),
              count_if(jobs, [&](const Counted& job) { return !is_final(job.state) && job.owner == owner; }));
  }
  for (const Counted& job : jobs) {
    const auto is_before = [&](const Counted& other) {
      return other.state == JobState::queued && other.queue == job.queue && comes_before(other, job);
    };
    ASSERT_EQ(tally.position(job.queue, job.rank, job.id), count_if(jobs, is_before));
    ASSERT_TRUE(job.state != JobState::queued || *tally.first_rank(job.queue) <= job.rank);
  }
}

// Jobs come, change and go; the tally says what counting them says.
TEST(JobTally, IsWhatCountingSays) {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const auto any_state = [&] { return job_states[random.next() % job_states.size()]; };
    JobTally tally;
    std::vector<Counted> jobs;
    for (int step = 0; step < steps && !testing::Test::HasFatalFailure(); ++step) {
      const std::uint64_t act = random.next() % 4;
      if (jobs.empty() || act == 0) {
        const std::string owner = std::vector<std::string>{"", "arm", "gantry"}[random.next() % 3];
        jobs.push_back({static_cast<std::int64_t>(random.next() % 20) - 10, "job " + std::to_string(step), owner,
                        random.next() % 2 == 0 ? "day" : "night", any_state()});
        tally.apply({{jobs.back().rank, jobs.back().id, owner, jobs.back().queue, std::nullopt, jobs.back().state}});
        continue;
      }
      const auto job = jobs.begin() + static_cast<std::ptrdiff_t>(random.next() % jobs.size());
      const bool goes = act == 1 && jobs.size() > 10;
      const std::optional<JobState> to = goes ? std::nullopt : std::optional(any_state());
      tally.apply({{job->rank, job->id, job->owner, job->queue, job->state, to}});
      goes ? static_cast<void>(jobs.erase(job)) : static_cast<void>(job->state = *to);
      if (step % 10 == 0) compare(tally, jobs);
    }
  }
}

}  // namespace
}  // namespace sculpt::server
