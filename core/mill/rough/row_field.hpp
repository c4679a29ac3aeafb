// What the rows of a level are level curves of.
#pragma once

#include <vector>

#include "core/mill/map/height_map.hpp"

namespace sculpt {

/// Values at the middles of a lattice's cells, linear in between; those outside are as at the border.
struct RowField {
  Lattice lattice;
  std::vector<float> values;

  double at(const Point2& p) const;
  /// Where the values become larger: a unit vector.
  Point2 outwards(const Point2& p) const;
};

}  // namespace sculpt
