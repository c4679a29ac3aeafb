// Cells of a lattice thinned to lines.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/mill/map/lattice.hpp"

namespace sculpt {

/// The eight around a cell that is not at the border, those beside it before those across its corners.
std::array<std::size_t, 8> neighbours(const Lattice& lattice, std::size_t cell);
/// How many lines meet in a cell: pieces of what is marked around it.
int branches(const std::vector<char>& marked, const Lattice& lattice, std::size_t cell);

/// Leaves lines one cell wide, joined as the marked cells were (Guo, Hall, "Parallel thinning with two-subiteration
/// algorithms", Comm. ACM 32, 1989). None at the border may be marked.
void thin(std::vector<char>& marked, const Lattice& lattice);

}  // namespace sculpt
