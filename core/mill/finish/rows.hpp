// Which rows over the part a set of nails needs, seen along the tool's axis.
#pragma once

#include <vector>

#include "core/mill/finish/envelope.hpp"
#include "core/mill/finish/nails.hpp"
#include "core/mill/map/tool_frame.hpp"

namespace sculpt {

/// In plan, m.
struct Row {
  Point2 from, to;
  std::vector<WallStop> stops;  ///< beside upright surface: the tips of balls that rest there
};

struct RowTask {
  double spacing_m = 0;  ///< of rows where the surface is level across them
  int finer = 0;         ///< so many times rows are twice as near
  double radius_m = 0;   ///< of the ball
  double area_m2 = 0;    ///< of the surface, for each ball
  /// Of a row's length, its ends and the way to the next one counted in: so much at least must be what a row would be
  /// that serves as many balls without an end and none twice.
  double least_worth = 0;
};

struct RestingBall {
  std::uint32_t nail = 0;  ///< that it rests on
  Vec3 middle;             ///< tool frame
};

/// Rows in one of four headings by where balls rest: along any where the surface is nearly level across it, else up and
/// down the slope, the nearer the steeper it is across them. Balls that no row is worth it for are left out, beside
/// walls none.
std::vector<Row> find_rows(const RowTask& task, const ToolFrame& frame, const Nails& nails,
                           const std::vector<RestingBall>& balls);

}  // namespace sculpt
