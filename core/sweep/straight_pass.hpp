// One pass along a straight tool direction.
#pragma once

#include <functional>
#include <optional>

#include "core/sweep/columns.hpp"
#include "core/sweep/pass.hpp"

namespace sculpt {

/// Where a pass is after a batch of layers. With it, what stands and where the arm is, the pass goes on as it would
/// have.
struct StraightMark {
  int layer = 0;                        ///< the next one
  std::size_t layers_at_once = 0;       ///< of the next batch
  std::vector<Columns::Run> given_up;   ///< in this pass
  std::vector<Columns::Run> held_here;  ///< of that in the next layer: each held a piece of material
  bool cut_since = false;               ///< something was cut in that layer since
  PassEnd so_far;
};

using NoteStraight = std::function<void(const StraightMark&)>;

/// Cuts all that lies free, layer by layer, and rises above everything again. Nothing is done where the arm finds no
/// way to the direction. Goes on at `from` if there is one: the arm is in the direction then. `note` is told of each
/// place from which the pass could go on. Deterministic, also in the number of threads. Throws Cancelled.
PassEnd cut_straight(Carving& carving, const PostureField& field, const ReachRows& reach,
                     const std::optional<StraightMark>& from, const NoteStraight& note);

}  // namespace sculpt
