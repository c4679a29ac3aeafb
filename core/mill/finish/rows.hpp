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
};

struct RestingBall {
  std::uint32_t nail = 0;  ///< that it rests on
  Vec3 middle;             ///< tool frame
};

/// Rows run up and down the slope through where balls rest, in one of four headings, the nearer the steeper the surface
/// is across them.
std::vector<Row> find_rows(const RowTask& task, const ToolFrame& frame, const Nails& nails,
                           const std::vector<RestingBall>& balls);

}  // namespace sculpt
