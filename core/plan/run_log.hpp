// A run as far as it must survive the process: what was done, put out and kept.
#pragma once

#include "core/collision/scene.hpp"
#include "core/plan/checkpoint_folder.hpp"
#include "core/plan/output.hpp"

namespace sculpt {

/// A unit of work changes `now` when it is over and says so; between that and the next one no more is added to it. All
/// calls from one thread. Throws InputError `file_unwritable`.
class RunLog {
 public:
  /// All must outlive the object. `found`: as it was found, or empty.
  RunLog(CheckpointFolder& kept, Checkpoint& found, Output& to, const Scene& scene)
      : now(found), output(to), kept_(kept), scene_(scene) {
    go_on();
  }

  Checkpoint& now;
  Output& output;

  bool keeps() const { return kept_.keeps(); }
  bool due() const { return kept_.due(); }

  /// What was tested until here was so by the run that this one goes on with as well.
  void go_on();
  /// Configurations tested by this run and those that it goes on with.
  std::uint64_t checks() const { return earlier_checks_ + scene_.checks(); }

  /// `now` is true after what was put out until here: a unit is over.
  void note();
  /// The same of a unit that puts out nothing; also once the output is finished.
  void note_state();
  /// What was noted last, if it is not kept yet.
  void save();
  void save_if_due();
  /// The same at a stop, which does not fail for want of space: what cannot be kept is done again.
  void save_at_stop();

 private:
  CheckpointFolder& kept_;
  const Scene& scene_;
  std::uint64_t earlier_checks_ = 0;  ///< by the runs before, less what this one did again
  bool unsaved_ = false;
};

}  // namespace sculpt
