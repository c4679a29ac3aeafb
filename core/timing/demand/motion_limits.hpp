// Cell -> what each coordinate of a plan may do.
#pragma once

#include "core/cell/cell.hpp"

namespace sculpt {

/// One value a coordinate; rad or m, seconds; all above 0.
struct MotionLimits {
  Configuration velocity, acceleration, jerk;
};

/// Of the chain's coordinates; what follows them (mimics) counts for them. Throws InputError `limits_missing` that
/// names the first joint without one.
MotionLimits limits_of(const Cell& cell, const Chain& chain);

}  // namespace sculpt
