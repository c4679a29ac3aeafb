// What of a run survives the process: how far it was, in a form that can be kept in a file.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/mill/mill_memory.hpp"
#include "core/motion/arm.hpp"
#include "core/motion/gantry/gantry.hpp"
#include "core/motion/residue.hpp"
#include "core/plan/checkpoint/milled_figures.hpp"
#include "core/search/block_order.hpp"
#include "core/sweep/sweep.hpp"
#include "core/trajectory/trajectory_start.hpp"
#include "core/verify/verify.hpp"

namespace sculpt {

/// After sweeping: `keyframes` of the file are its own, what follows is the arm's.
struct SweptMark {
  std::uint64_t keyframes = 0;
  std::vector<Voxel> out_of_tool_reach;
};

/// Together with the first lines of the trajectory file it says all that a run needs to go on.
struct Checkpoint {
  TrajectoryStart file;
  std::uint64_t checks = 0;                     ///< configurations tested
  std::optional<SweepMemory> sweeping;          ///< until the sweep is over
  std::optional<SweptMark> swept;               ///< from then on
  std::vector<BlockTrial> trials;               ///< of the outer search, in order: what came of them
  ArmMemory arm;                                ///< after the last trial
  std::vector<Refusal> refusals;                ///< of a translating robot, in order: what it had to go around
  std::optional<std::vector<Residue>> residue;  ///< once the plan is finished
  ReplayedPieces replayed;                      ///< how far the replay of a finished plan is
  std::optional<SweepFigures> sweep_figures;    ///< once the sweep is over
  std::optional<MillMemory> milling;            ///< from the first change of tools until all is cut
  std::optional<MilledFigures> milled;          ///< from then on
};

/// `key` says which job by which program the checkpoint is of; `number` counts up from checkpoint to checkpoint.
std::string checkpoint_text(const Checkpoint& checkpoint, const std::string& key, std::uint64_t number);

struct NumberedCheckpoint {
  std::uint64_t number = 0;
  Checkpoint checkpoint;
};

/// Nothing if the text is damaged or of another key.
std::optional<NumberedCheckpoint> read_checkpoint(std::string_view text, const std::string& key);

}  // namespace sculpt
