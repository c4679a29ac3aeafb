// Square cells across a tool's axis.
#pragma once

#include <cmath>
#include <cstddef>

namespace sculpt {

/// Square cells of edge `step`, from (low_u, low_v) on.
struct Lattice {
  double low_u = 0, low_v = 0, step = 0;
  int width = 0, height = 0;  ///< cells along u, along v

  std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  bool contains(int a, int b) const { return a >= 0 && b >= 0 && a < width && b < height; }
  std::size_t index(int a, int b) const {
    return static_cast<std::size_t>(b) * static_cast<std::size_t>(width) + static_cast<std::size_t>(a);
  }
  int cell_u(double u) const { return static_cast<int>(std::floor((u - low_u) / step)); }
  int cell_v(double v) const { return static_cast<int>(std::floor((v - low_v) / step)); }
  /// Middle of a cell.
  double u(int a) const { return low_u + (a + 0.5) * step; }
  double v(int b) const { return low_v + (b + 0.5) * step; }
};

}  // namespace sculpt
