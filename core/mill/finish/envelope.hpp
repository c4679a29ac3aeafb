// The lowest a ball cutter may go along straight lines in plan: its rest on the part, followed up and down.
#pragma once

#include <functional>
#include <vector>

#include "core/mill/finish/facet_columns.hpp"

namespace sculpt {

/// How near a cutter's ball is led over the part (m).
struct EnvelopeTask {
  const FacetColumns& columns;
  double radius_m = 0;     ///< of the ball
  double allowance_m = 0;  ///< it rests so far off the part
  double clear_m = 0;      ///< and is nowhere nearer than this on an edge: less than the allowance
  double chord_m = 0;      ///< an edge may be farther off the rest than its ends, by so much
  double bottom_m = 0;     ///< nothing to rest on is looked for below
  std::function<bool(const Vec3& from, const Vec3& to)> is_allowed;  ///< may the tip go so, for all the rest?
};

/// Tips, in the tool's frame; each of its edges is proved.
using Contour = std::vector<Vec3>;

double length_m(const Contour& contour);

/// The tip straight from one place to another: for the part and all the rest?
bool may_go(const EnvelopeTask& task, const Vec3& from, const Vec3& to);

/// Where the tip is beside a wall whose foot it does not come to.
struct WallStop {
  double along_m = 0;  ///< from where the line begins, in plan
  double height_m = 0;
};

/// From one place in plan straight to another; in pieces where it cannot go through. Down a wall whose foot it may not
/// come to it goes as low as the stops near there, or as it may. `stops`: ascending along the line.
std::vector<Contour> follow_envelope(const EnvelopeTask& task, const Point2& from, const Point2& to,
                                     const std::vector<WallStop>& stops = {});
/// A way in one piece, like a string that is pulled tight over where it rests; nothing where that is longer than this.
Contour follow_whole(const EnvelopeTask& task, const Point2& from, const Point2& to, double max_length_m);

}  // namespace sculpt
