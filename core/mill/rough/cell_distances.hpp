// How far the cells of a lattice are from marked ones.
#pragma once

#include <vector>

#include "core/mill/map/height_map.hpp"

namespace sculpt {

/// Of the middle of each cell to that of the nearest marked one (m), exact up to `far` cells, and that where it is
/// more: along rows, then across, row beside row.
std::vector<float> distances_to(const std::vector<char>& marked, const Lattice& lattice, int far);

}  // namespace sculpt
