// Rows up and down steep surface, seen along the tool's axis.
#pragma once

#include <vector>

#include "core/mill/finish/envelope.hpp"
#include "core/mill/finish/nails.hpp"
#include "core/mill/finish/rows/resting_ball.hpp"
#include "core/mill/map/tool_frame.hpp"

namespace sculpt {

/// In plan.
struct Row {
  Point2 from, to;              ///< m
  std::vector<WallStop> stops;  ///< beside upright surface: the tips of balls that rest there
};

struct RowTask {
  double spacing_m = 0;  ///< of rows where the surface is level across them
  int finer = 0;         ///< so many times rows are twice as near
  double radius_m = 0;   ///< of the ball
  double area_m2 = 0;    ///< of the surface, for each ball
};

/// Rows through where balls rest, each along that of four headings that is nearest to up and down the slope there; the
/// nearer to each other the steeper the surface is across them.
std::vector<Row> wall_rows(const RowTask& task, const ToolFrame& frame, const Nails& nails,
                           const std::vector<RestingBall>& balls);

}  // namespace sculpt
