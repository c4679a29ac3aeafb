// Would the arm reach more of the stock if the table stood elsewhere?
#pragma once

#include <optional>

#include "core/base/run_context.hpp"
#include "core/doctor/findings.hpp"

namespace sculpt {

/// The cell with what carries the stock shifted: the joint nearest to the room that moves or holds it but not the arm,
/// else the stock's cube. `by_m` in the frame that this joint hangs in, else in the stock link's.
Cell move_table(const Cell& cell, const Vec3& by_m);

/// A shift of the table that lets the arm reach more, from the best of a few that were tried; nothing where none does.
/// `start`: a configuration in which the arm is clear. Throws Cancelled.
std::optional<Fault> suggest_move(const Cell& cell, const Configuration& start, const CellFindings& found,
                                  const RunContext& run);

}  // namespace sculpt
