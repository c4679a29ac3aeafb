// A part of a lattice.
#pragma once

#include <algorithm>

#include "core/mill/map/lattice.hpp"

namespace sculpt {

/// Cells from the first to the last along each axis; empty where a last one is before its first.
struct CellBox {
  int first_a, last_a, first_b, last_b;

  bool is_empty() const { return first_a > last_a || first_b > last_b; }
  CellBox grown(int cells, const Lattice& all) const {
    return {std::max(0, first_a - cells), std::min(all.width - 1, last_a + cells), std::max(0, first_b - cells),
            std::min(all.height - 1, last_b + cells)};
  }
  Lattice of(const Lattice& all) const {
    return {all.low_u + first_a * all.step, all.low_v + first_b * all.step, all.step, last_a - first_a + 1,
            last_b - first_b + 1};
  }
  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (int b = first_b; b <= last_b; ++b)
      for (int a = first_a; a <= last_a; ++a) visit(a, b);
  }
};

/// The cells over a box (m), those that it touches as well.
inline CellBox cells_over(const Lattice& lattice, double low_u, double high_u, double low_v, double high_v) {
  return {std::max(0, lattice.cell_u(low_u - 1e-9)), std::min(lattice.width - 1, lattice.cell_u(high_u + 1e-9)),
          std::max(0, lattice.cell_v(low_v - 1e-9)), std::min(lattice.height - 1, lattice.cell_v(high_v + 1e-9))};
}

}  // namespace sculpt
