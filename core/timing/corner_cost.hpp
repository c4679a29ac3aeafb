// What cutting off a corner costs: how far it strays, as a share of what it may. Internal to core/timing.
#pragma once

#include "core/timing/edge.hpp"
#include "core/timing/room/edge_room.hpp"
#include "core/timing/room/stray_bound.hpp"

namespace sculpt {

inline constexpr double max_parabola_share = 0.65;  ///< of what may be strayed; the rest is the moving average's

/// Of a displacement of the joints by w - u, the difference of the edges' directions.
struct CornerCost {
  double share = 0;          ///< of all that is allowed
  double share_by_turn = 0;  ///< more for each rad that the tool turns between the corner and where it is displaced
  double tool_m = 0;         ///< how far ball or shank's end go
  double room_m = 0;         ///< how far they may
  double turn = 0;           ///< bound of the tool's turning
  double travel = 0;         ///< and of how far any point of it goes (m)
  double parabola = max_parabola_share;  ///< share of what may be strayed that is the parabola's
  double wanted = 0;                     ///< largest half of the parabola
  bool confined = false;                 ///< at most to the middles of both edges
  bool straight = false;                 ///< there is no corner
};

/// One of the two edges at a corner.
struct CornerEdge {
  const PathEdge& edge;
  const EdgeRoom& room;
};

struct CornerPlace {
  const ToolRates& rates;
  const StrayBound& stray;
  std::size_t point;
  bool above;  ///< the tool stays above the stock's bottom all around
};

/// `window_s`: of the moving average.
CornerCost find_cost(const CornerPlace& place, const std::pair<CornerEdge, CornerEdge>& edges, double window_s);

}  // namespace sculpt
