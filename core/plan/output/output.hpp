// The trajectory file as it grows, and the figures of what was written.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <vector>

#include "core/base/watch.hpp"
#include "core/plan/output/batch_writer.hpp"
#include "core/plan/output/path_figures.hpp"
#include "core/trajectory/binary/binary.hpp"
#include "core/trajectory/form.hpp"
#include "core/trajectory/timeline.hpp"
#include "core/trajectory/writer.hpp"

namespace sculpt {

/// The files of a run.
struct OutputPlace {
  std::filesystem::path trajectory;
  TrajectoryForm form = TrajectoryForm::text;
  std::filesystem::path timeline = {};  ///< empty: none
};

/// Which trajectory, of which voxels, is written where; it must outlive the call.
struct OutputTask {
  const OutputPlace& place;
  const TrajectoryHeader& header;
  const Chain& chain;
  const VoxelGrid& voxels;
  std::uint64_t remove = 0;  ///< voxels to come, for the watch
  int threads = 1;           ///< with more than one, writing is done on one of its own
};

/// All calls from one thread. Throws InputError `file_unwritable`; what tells the watch, `add`, Cancelled too.
class Output {
 public:
  Output(const OutputTask& task, const Watch& watch);
  /// Goes on with a file in the text form that begins with `start` and the same header: what follows is cut off, and
  /// `visit` gets the keyframes that stay. The timeline is written anew.
  Output(const OutputTask& task, const TrajectoryStart& start, const std::function<void(const Keyframe&)>& visit,
         const Watch& watch);

  void add(std::vector<Keyframe> batch);
  void add(const Keyframe& keyframe);
  /// What was added so far will be in the file soon.
  void flush();
  /// `grown` is called now, and whenever more of the file can be read, on the thread that writes. Before anything is
  /// added.
  void tell_of_growth(std::function<void()> grown);
  /// That many were added, and stay of an earlier run.
  std::uint64_t keyframes() const { return keyframes_; }
  /// A run could go on after what was added so far.
  void mark();
  /// What was added until the last mark, durable now.
  TrajectoryStart sync();
  TrajectoryEnd finish();
  /// Once finished.
  const PathFigures& figures() const { return figures_; }

 private:
  /// `lines`: they go into the file from the first on.
  Output(const OutputTask& task, std::ios::openmode mode, bool lines, const Watch& watch);
  void start_writing(int threads);
  void count(const Keyframe& keyframe);
  void hand_over(std::vector<Keyframe> batch);
  void write(const Keyframe& keyframe);
  void write(const std::vector<Keyframe>& batch);
  void send();
  void take_mark();
  void check() const;

  std::filesystem::path path_;
  std::ofstream file_;
  std::ostream lines_;     ///< into the file, or nowhere
  TrajectoryWriter text_;  ///< makes the hash in either form
  std::optional<BinaryWriter> binary_;
  std::ofstream timeline_file_;
  std::optional<TimelineWriter> timeline_;
  PathFigures figures_;
  TrajectoryStart marked_;           ///< set where lines are written, read when that waits
  std::uint64_t started_bytes_ = 0;  ///< that the disk was told of
  std::uint64_t keyframes_ = 0, removed_ = 0, remove_;
  const Watch& watch_;
  std::function<void()> grown_;
  std::vector<Keyframe> waiting_;
  std::optional<BatchWriter> beside_;  ///< of jobs with more than one thread; last: what it writes to must outlive it
};

}  // namespace sculpt
