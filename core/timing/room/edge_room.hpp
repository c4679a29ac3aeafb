// How far ball and shank may stray on an edge, found out again from the plan: what the planner knew and the file does
// not say. Internal to core/timing.
//
// A tool whose axis goes along one of the grid's, with ball and shank's end within o of the middle of a column of
// cells, stays in that column if it strays by less than 0.5 voxel - radius - o; so it touches nothing if nothing stands
// in the column from the ball's cell on, but for the voxel that is being cut. An edge from the middle of one cell to
// that of another in line with it goes through the cells between, and may leave the line by its sagitta b: at a share t
// of it by 4 b t (1 - t) and what the fourth derivative adds. All this is above the stock's bottom, so what stands
// still in the stock's frame must be below that, else nothing is said.
#pragma once

#include <algorithm>

#include "core/cell/cell.hpp"
#include "core/timing/edge.hpp"
#include "core/timing/plan_path.hpp"
#include "core/timing/room/open_columns.hpp"

namespace sculpt {

/// Of an edge, for one end of the tool; m.
struct EndRoom {
  double room = 0;     ///< where the edge begins and ends
  double sagitta = 0;  ///< less in its middle
  double more = 0;     ///< less there, by the square of how near it is

  /// Up to a share of the edge from either end.
  double up_to(double share) const {
    const double part = std::min(share, 0.5), in = 4 * part * (1 - part);
    return room - sagitta * in - more * in * in;
  }
};

struct EdgeRoom {
  bool known = false;  ///< else only what all certificates leave
  EndRoom ball, top;
};

/// Follows a plan from its beginning. Not shared between threads.
class EdgeRoomFinder {
 public:
  EdgeRoomFinder(const PlanPath& path, const Cell& cell, const Chain& chain, double reserve_m);

  /// Of the edge to this point, the next one.
  EdgeRoom go_to(std::size_t point, const EdgeSagitta& sagitta, const EdgePlaces& places);

 private:
  struct Ends;
  EdgeRoom in_columns(int voxels, const Ends& ends);
  EdgeRoom above_all(const Ends& ends);

  const PlanPath& path_;
  Grid grid_;
  double ball_radius_, shank_radius_, stickout_m_, tolerance_, reserve_;  // in voxel edges but for stickout_m_
  bool all_below_;  // what stands still beside the stock is below its bottom
  OpenColumns columns_;
};

}  // namespace sculpt
