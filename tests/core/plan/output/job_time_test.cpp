#include "core/plan/output/job_time.hpp"

#include <gtest/gtest.h>

#include "tests/core/plan/jobs.hpp"

namespace sculpt {
namespace {

class JobTime : public testing::Test {
 protected:
  JobTime() {
    job.cell = shipped_cell_files("gantry");
    job.mesh = binvox_file(random_target(8, 3), job.cell);
    job.resolution = 8;
    report = run_job(job, file.path(), {}).report;
  }
  std::optional<InputError> time(const MotionOrder& order) {
    job.motion = order;
    return time_job(job, file.path(), report, {});
  }

  const ScratchFile file;
  Job job;
  Report report;
};

TEST_F(JobTime, AJobThatDoesNotAskIsNotTimed) {
  EXPECT_FALSE(time_job(job, file.path(), report, {}));
  EXPECT_FALSE(report.time);
}

TEST_F(JobTime, ASlowerFeedTakesLonger) {
  EXPECT_FALSE(time({0.05, 0.5, {}}));
  const double quick_s = report.time.value().time.total;
  EXPECT_FALSE(time({0.01, 0.5, {}}));
  EXPECT_GT(report.time.value().time.total, 2 * quick_s);
}

TEST_F(JobTime, AFeedThatIsNotKeptIsGivenBackWithTheTimesOfWithoutIt) {
  EXPECT_FALSE(time({0.4, 0.5, {}}));
  const double total_s = report.time.value().time.total;
  report.time.reset();
  const std::optional<InputError> unkept = time({0.4, 0.5, 0.99});
  ASSERT_TRUE(unkept);
  EXPECT_EQ(unkept->code(), "feed_not_kept");
  EXPECT_EQ(report.time.value().time.total, total_s);
  EXPECT_FALSE(time({0.001, 0.5, 0.9})) << "slowly enough it is kept";
}

TEST_F(JobTime, WhatCannotBeAskedForIsRefused) {
  EXPECT_THROW(time({}), InputError) << "a thin tool has no feed";
  EXPECT_THROW(time({0, 0.5, {}}), InputError);
}

}  // namespace
}  // namespace sculpt
