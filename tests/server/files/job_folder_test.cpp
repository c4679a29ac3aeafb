#include "server/files/job_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/server/temp_folder.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

class JobFolderTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(jobs); }
  void write(const std::string& name, const std::string& text) { std::ofstream(jobs / name) << text; }
  std::string read(const std::string& name) {
    std::ifstream in(jobs / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  TempFolder folder;
  fs::path jobs = folder.path() / "jobs";
};

TEST_F(JobFolderTest, AnAttemptGoesOnWithACopyOfTheLast) {
  EXPECT_EQ(prepare_job_folder(jobs, "JOB/1"), jobs / "JOB/1");
  write("JOB/1/checkpoint-0", "saved");
  write("JOB/1/trajectory.ndjson", "half");
  write("JOB/1/report.json.draft", "never finished");
  write("JOB/1/trajectory.csv", "made of a result");
  std::ofstream late(jobs / "JOB/1/trajectory.ndjson", std::ios::app);  // the run that lost the job
  prepare_job_folder(jobs, "JOB/3");
  EXPECT_EQ(read("JOB/3/checkpoint-0"), "saved");
  EXPECT_EQ(read("JOB/3/trajectory.ndjson"), "half");
  EXPECT_FALSE(fs::exists(jobs / "JOB/3/report.json.draft"));
  EXPECT_FALSE(fs::exists(jobs / "JOB/3/trajectory.csv"));
  late << " and more" << std::flush;
  EXPECT_EQ(read("JOB/3/trajectory.ndjson"), "half") << "what it writes does not reach the new run";
  EXPECT_FALSE(fs::exists(jobs / "JOB/1"));
}

TEST_F(JobFolderTest, ALateAttemptTakesNothingFromALaterOne) {
  prepare_job_folder(jobs, "JOB/3");
  write("JOB/3/trajectory.ndjson", "the new run");
  prepare_job_folder(jobs, "JOB/2");
  EXPECT_FALSE(fs::exists(jobs / "JOB/2/trajectory.ndjson"));
  EXPECT_EQ(read("JOB/3/trajectory.ndjson"), "the new run");
  remove_other_attempts(jobs, "JOB/3");
  EXPECT_FALSE(fs::exists(jobs / "JOB/2"));
  EXPECT_EQ(read("JOB/3/trajectory.ndjson"), "the new run");
}

TEST_F(JobFolderTest, WithOneDaemonTheFolderIsTheJobs) {
  EXPECT_EQ(prepare_job_folder(jobs, "JOB"), jobs / "JOB");
  write("JOB/trajectory.ndjson", "half");
  write("JOB/trajectory.csv", "made of a result");
  fs::create_symlink("/etc/passwd", jobs / "JOB/report.json");
  prepare_job_folder(jobs, "JOB");
  EXPECT_EQ(read("JOB/trajectory.ndjson"), "half");
  EXPECT_FALSE(fs::exists(jobs / "JOB/trajectory.csv"));
  EXPECT_FALSE(fs::is_symlink(jobs / "JOB/report.json"));
  remove_other_attempts(jobs, "JOB");
  EXPECT_EQ(read("JOB/trajectory.ndjson"), "half");
}

TEST_F(JobFolderTest, AFolderThatWasNotFinishedIsMadeAnew) {
  prepare_job_folder(jobs, "JOB/1");
  write("JOB/1/checkpoint-1", "saved");
  fs::create_directories(jobs / "JOB/2.draft");
  write("JOB/2.draft/checkpoint-1", "half of a copy");
  prepare_job_folder(jobs, "JOB/2");
  EXPECT_EQ(read("JOB/2/checkpoint-1"), "saved");
  EXPECT_FALSE(fs::exists(jobs / "JOB/2.draft"));
}

}  // namespace
}  // namespace sculpt::server
