// A tour's contours -> those without the parts at their ends that are not worth it.
#pragma once

#include <cstddef>
#include <vector>

#include "core/mill/finish/cut_preview.hpp"
#include "core/mill/finish/tour/contour_steps.hpp"

namespace sculpt {

struct TrimTask {
  std::size_t nails = 0;        ///< how many there are
  double nail_worth_m = 0;      ///< to finish one is worth so long a path, where nothing that is left of the tour does
  double far_m = 0;             ///< no way from one contour to the next counts as longer
  std::size_t spare_steps = 0;  ///< what is trimmed from an end is less by so many, for the surface between nails
};

/// Of each contour what is left of it, a step or more. `finished`: of each contour, by step, the nails that it
/// finishes.
std::vector<StepSpan> trim_ends(const TrimTask& task, const std::vector<ContourSteps>& tour,
                                const std::vector<EdgeNails>& finished);

}  // namespace sculpt
