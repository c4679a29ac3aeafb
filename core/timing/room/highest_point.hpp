// How high up a link reaches. Internal to core/timing.
#pragma once

#include <vector>

#include "core/cell/cell.hpp"

namespace sculpt {

/// Largest z of the link's shapes, with the links at `poses` (m); minus infinity for a link without.
double highest_point(const Cell& cell, int link, const std::vector<Frame>& poses);

}  // namespace sculpt
