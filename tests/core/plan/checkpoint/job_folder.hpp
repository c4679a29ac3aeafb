// Runs of a job in a folder of their own, that are stopped and killed and go on.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "core/plan/checkpoint/checkpoint_folder.hpp"
#include "core/plan/job_key.hpp"
#include "core/trajectory/reader.hpp"
#include "core/trajectory/timeline.hpp"
#include "tests/core/plan/jobs.hpp"

namespace sculpt {

using Interval = std::chrono::duration<double>;
inline constexpr Interval always{0}, now_and_then{0.02}, at_stops_only{3600};

/// What a run leaves: its bytes, and its report but for what the machine decides.
struct Outcome {
  std::string trajectory, timeline, report, residue;
  bool operator==(const Outcome&) const = default;
};

inline Outcome outcome(const JobResult& result, const std::filesystem::path& trajectory, const std::string& timeline) {
  auto report = nlohmann::json::parse(report_json(result.report));
  report.erase("seconds");
  report.erase("peak_memory_bytes");
  return {read_file(trajectory), timeline, report.dump(), residue_ndjson(result.residue)};
}

/// In memory where that can be had: a disk takes long to sync a checkpoint at every step.
inline std::filesystem::path quick_folder() {
  return std::filesystem::is_directory("/dev/shm") ? std::filesystem::path("/dev/shm")
                                                   : std::filesystem::temp_directory_path();
}

/// A job's folder; gone at the end.
class JobFolder {
 public:
  explicit JobFolder(Job job) : job_(std::move(job)) {
    std::string pattern = (quick_folder() / "sculpt-test-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~JobFolder() { std::filesystem::remove_all(folder_); }

  std::filesystem::path trajectory() const { return folder_ / "trajectory.ndjson"; }
  std::filesystem::path timeline() const { return folder_ / "timeline.tokens"; }
  std::filesystem::path slot(int number) const { return folder_ / ("checkpoint-" + std::to_string(number)); }
  const std::filesystem::path& folder() const { return folder_; }

  Outcome run(const Watch& watch = {}, Interval interval = always) const {
    const JobResult result = resume_job(job_, trajectory(), {folder_, interval, timeline()}, watch);
    return outcome(result, trajectory(), read_file(timeline()));
  }
  /// In a process that gets SIGKILL the `last`-th time that it told how far it was. False if it ended before that.
  bool run_killed(std::uint64_t last, Interval interval = always) const {
    const pid_t child = fork();
    if (child == 0) {
      Watch watch;
      watch.tell = [last, told = std::uint64_t{0}](const Progress&) mutable {
        if (told++ == last) raise(SIGKILL);
      };
      run(watch, interval);
      _exit(0);
    }
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
  }
  /// Asked to stop the `last`-th time that it told how far it was. False if it ended all the same.
  bool run_stopped(std::uint64_t last) const {
    std::stop_source stop;
    Watch watch;
    watch.stop = stop.get_token();
    watch.tell = [&, told = std::uint64_t{0}](const Progress&) mutable {
      if (told++ == last) stop.request_stop();
    };
    try {
      run(watch, at_stops_only);
      return false;
    } catch (const Cancelled&) {
      return true;
    }
  }
  /// Voxels that the last checkpoint keeps for good.
  std::uint64_t kept() const {
    const auto found = checkpoint();
    if (!found) return 0;
    std::ifstream in(trajectory(), std::ios::binary);
    TrajectoryReader reader(in);
    std::uint64_t removed = 0;
    for (std::uint64_t at = 0; at < found->file.keyframes; ++at)
      removed += static_cast<std::uint64_t>(run_length(reader.next().value()));
    return removed;
  }
  std::optional<Checkpoint> checkpoint() const {
    return CheckpointFolder(folder_, trajectory(), job_key(job_), always).find_newest();
  }

 private:
  Job job_;
  std::filesystem::path folder_;
};

inline std::string timeline_of(const JobResult& result, const std::filesystem::path& trajectory) {
  std::ifstream in(trajectory, std::ios::binary);
  TrajectoryReader reader(in);
  std::ostringstream out;
  TimelineWriter timeline(out, reader.header(), result.voxels);
  while (const auto keyframe = reader.next()) timeline.add(*keyframe);
  timeline.flush();
  return out.str();
}

inline Outcome uninterrupted(const Job& job, std::vector<Progress>* told = nullptr) {
  const ScratchFile file;
  Watch watch;
  if (told != nullptr) watch.tell = [told](const Progress& progress) { told->push_back(progress); };
  const JobResult result = run_job(job, file.path(), watch);
  return outcome(result, file.path(), timeline_of(result, file.path()));
}

/// How many steps were told before the replay: as many every time. Those of a replay by two threads depend on which is
/// the faster one.
inline std::ptrdiff_t before_replay(const std::vector<Progress>& told) {
  return std::ranges::find(told, Stage::verify, &Progress::stage) - told.begin();
}

}  // namespace sculpt
