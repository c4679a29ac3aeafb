// One row of a level.
#pragma once

#include "core/mill/map/level_curves.hpp"
#include "core/mill/rough/row_field.hpp"

namespace sculpt {

struct LevelRow {
  const RowField* field = nullptr;  ///< that it is a level curve of
  Curve points;
  bool is_closed = false;
  int rank = 0;  ///< those of larger rank come before those near them
};

/// Do two rows have places so near to each other?
bool are_near(const LevelRow& one, const LevelRow& other, double near_m);
/// Begins with the end that is nearer, a ring with its nearest place.
void turn_towards(LevelRow& row, const Point2& at);

}  // namespace sculpt
