// Plan and cell -> programs for a controller.
#pragma once

#include <functional>

#include "core/program/program_demands.hpp"
#include "core/program/write/part_writer.hpp"
#include "core/timing/timed_plan.hpp"

namespace sculpt {

/// Every part is read back before it is handed to `take`, and held against the plan: joints within what the plan's
/// certificates leave (StrayBound), times not shorter. Throws InputError: `axes_unfit`, `name_invalid`,
/// `part_invalid`, `rounding_too_coarse`, `speed_too_coarse`, and those of time_plan. Files come one part after the
/// other, the main program last.
ProgramReport make_program(const PlanPath& path, const Cell& cell, const ProgramDemands& demands,
                           const std::function<void(const ProgramFile&)>& take);

}  // namespace sculpt
