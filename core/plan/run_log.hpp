// A run as far as it must survive the process: it hears of all stages, puts out what they emit, and keeps how far they
// are.
#pragma once

#include <vector>

#include "core/collision/scene.hpp"
#include "core/mill/mill.hpp"
#include "core/motion/arm_carve.hpp"
#include "core/motion/gantry/gantry.hpp"
#include "core/plan/checkpoint/checkpoint_folder.hpp"
#include "core/plan/output/output.hpp"
#include "core/plan/replay_beside.hpp"
#include "core/sweep/sweep.hpp"

namespace sculpt {

/// A stage is worked off in units: a batch of layers, a block, a keyframe of a gantry, a milling tool, a piece of the
/// replay. When a unit is over, the checkpoint is brought up to date, and is true until the next unit is. It is kept in
/// the folder when that is due. One call at a time, those of the listeners too. Throws InputError `file_unwritable`.
class RunLog {
 public:
  /// All must outlive the object. `found`: the checkpoint that was found, or an empty one. `replay`, `scene`: none of a
  /// plan with milling tools, which is replayed once it is whole.
  RunLog(CheckpointFolder& kept, Checkpoint& found, Output& to, const ReplayBeside* replay = nullptr,
         const Scene* scene = nullptr)
      : now_(found), output_(to), replay_(replay), kept_(kept), scene_(scene) {
    go_on();
  }

  /// Where the run is, or where it goes on.
  const Checkpoint& now() const { return now_; }
  /// Configurations tested by this run and by those that it goes on with.
  std::uint64_t checks() const { return earlier_checks_ + own_checks(); }

  /// They refer to this object.
  SweepListener hear_sweep();
  GantryListener hear_gantry();
  ArmListener hear_arm();
  MillListener hear_mill();

  void end_sweep(const SweepRest& left);
  void end_arm(const ArmMemory& memory) { now_.arm = memory; }
  void end_carving();
  /// Of a plan with milling tools: all that only the replay comes after.
  void end_milling(MilledFigures figures, std::vector<Residue> residue);
  /// Of a plan whose output is finished.
  void end_plan(std::vector<Residue> residue);
  /// While only the replay goes on.
  void note_replay();
  /// What was noted last, while a unit takes long.
  void save_if_due();
  /// Keeps what units have finished. A stop does not fail for want of space: what cannot be kept is done again.
  void save_at_stop();

 private:
  /// What was tested in this process until here, the run that this one goes on with had tested as well.
  void go_on();
  /// A unit that put something out is over.
  void note();
  /// A unit is over that put out nothing, or came after all output.
  void note_state();
  /// What was noted last, if it is not kept yet.
  void save();
  std::uint64_t own_checks() const { return scene_ == nullptr ? 0 : scene_->checks(); }

  Checkpoint& now_;
  Output& output_;
  const ReplayBeside* replay_;
  CheckpointFolder& kept_;
  const Scene* scene_;
  std::uint64_t earlier_checks_ = 0;  ///< by the runs before, less what this one did again
  bool unsaved_ = false;
};

}  // namespace sculpt
