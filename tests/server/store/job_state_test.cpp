#include "server/store/job_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.hpp"
#include "server/base/job_id.hpp"
#include "server/base/time_stamp.hpp"

namespace sculpt::server {
namespace {

TEST(JobState, EveryStateHasAName) {
  for (const JobState state : job_states) EXPECT_EQ(find_state(name(state)), state);
  EXPECT_FALSE(find_state("interrupted"));
}

TEST(JobState, AFinalStateIsLeftOnlyByRetryingAQuarantinedJob) {
  for (const JobState from : job_states) {
    for (const JobState to : job_states) {
      const bool retry = to == JobState::queued &&
                         (from == JobState::quarantined || from == JobState::succeeded || from == JobState::failed);
      EXPECT_EQ(is_final(from) && may_move(from, to), retry) << name(from) << " " << name(to);
    }
  }
}

TEST(JobState, FromEveryOtherStateAJobCanBeCancelled) {
  for (const JobState from : job_states) {
    const bool cancels = may_move(from, JobState::cancelled) || may_move(from, JobState::cancelling);
    EXPECT_EQ(cancels, !is_final(from)) << name(from);
  }
}

TEST(JobState, OnlyAJobThatRunsSucceedsOrFails) {
  for (const JobState from : job_states) {
    const bool runs = from == JobState::running || from == JobState::pausing;
    EXPECT_EQ(may_move(from, JobState::succeeded), runs);
    EXPECT_EQ(may_move(from, JobState::failed), runs);
  }
}

TEST(JobId, IdsRiseWhateverTheClockDoes) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    IdMaker ids;
    std::string last;
    for (int i = 0; i < 500; ++i) {
      const std::string id = ids.next(1'700'000'000'000 + random.next() % 5);
      ASSERT_EQ(id.size(), 26u);
      ASSERT_GT(id, last);
      last = id;
    }
    EXPECT_GT(IdMaker(last).next(1), last);
  }
}

TEST(TimeStamp, IsUtcWithMilliseconds) {
  EXPECT_EQ(utc_text(0), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(utc_text(1769860800007), "2026-01-31T12:00:00.007Z");
}

}  // namespace
}  // namespace sculpt::server
