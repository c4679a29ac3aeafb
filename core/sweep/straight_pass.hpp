// One pass along a straight tool direction.
#pragma once

#include "core/sweep/pass.hpp"
#include "core/sweep/reach_rows.hpp"

namespace sculpt {

/// Cuts all that lies free, layer by layer, and rises above everything again. Nothing is done where the arm finds no
/// way to the direction. Deterministic, also in the number of threads. Throws Cancelled.
PassEnd cut_straight(Carving& carving, const PostureField& field, const ReachRows& reach);

}  // namespace sculpt
