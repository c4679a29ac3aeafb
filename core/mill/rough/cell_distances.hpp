// How far the cells of a lattice are from marked ones.
#pragma once

#include <vector>

#include "core/base/helpers.hpp"
#include "core/mill/map/height_map.hpp"

namespace sculpt {

/// Of the middle of each cell to that of the nearest marked one (m); where none is marked, farther than the lattice is
/// wide. Exact: along rows, then across by lower envelopes of parabolas (Felzenszwalb, Huttenlocher, "Distance
/// transforms of sampled functions", Theory of Computing 8, 2012).
std::vector<float> distances_to(const std::vector<char>& marked, const Lattice& lattice,
                                const Helpers* helpers = nullptr);

}  // namespace sculpt
