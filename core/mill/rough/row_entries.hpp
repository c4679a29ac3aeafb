// How the tip comes to the beginning of a row, at the height of its level.
#pragma once

#include <vector>

#include "core/mill/rough/level_rows.hpp"

namespace sculpt {

/// Places of the tip at the height of a level, one straight to the next (m, tool frame).
using LevelWay = std::vector<Point2>;

double length_of(const LevelWay& way);

/// Ways to the beginning of a row, which they end with: from there, straight from farther outside, from before it or
/// both, and into a ring bit by bit. `radius_m`: of the cutter; `width_m`: from row to row.
std::vector<LevelWay> ways_into(const LevelRow& row, double radius_m, double width_m);

}  // namespace sculpt
