// Roughing with one tool: direction after direction, the one with most to gain first.
#pragma once

#include "core/mill/carver.hpp"

namespace sculpt {

/// With the tool that `carver` holds. Throws InputError, Cancelled.
void rough(const MillJob& job, Carver& carver, const RunContext& run);

}  // namespace sculpt
