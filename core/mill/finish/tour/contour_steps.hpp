// A contour in steps no longer than a length: what a tool does on each of them is known, so it may be used in part.
#pragma once

#include <cstddef>
#include <vector>

#include "core/mill/finish/envelope.hpp"

namespace sculpt {

struct ContourSteps {
  Contour places;                    ///< a step is from each to the next
  std::vector<std::size_t> corners;  ///< the places that the contour has itself
};

/// From a place of a contour in steps to another.
struct StepSpan {
  std::size_t first = 0, last = 0;
};

ContourSteps in_steps(const Contour& contour, double step_m);

/// That part of a contour that was found along straight lines in plan: its ends at rest like all others. Longer than
/// asked for where the rest is not found between a corner and an end.
Contour part_of(const ContourSteps& steps, const StepSpan& span, const EnvelopeTask& task);

}  // namespace sculpt
