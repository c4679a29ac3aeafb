#include "core/timing/corner_cost.hpp"

#include <algorithm>

namespace sculpt {
namespace {

/// Of ball and of shank's end.
struct Rooms {
  double ball, top;
};

/// What the two edges leave as far from the corner as `reach` (by r); nothing where one of them is not known.
Rooms rooms_of(const std::pair<CornerEdge, CornerEdge>& edges, double reach) {
  if (!edges.first.room.known || !edges.second.room.known) return {0, 0};
  const double first = reach / edges.first.edge.length, second = reach / edges.second.edge.length;
  return {std::min(edges.first.room.ball.up_to(first), edges.second.room.ball.up_to(second)),
          std::min(edges.first.room.top.up_to(first), edges.second.room.top.up_to(second))};
}

}  // namespace

CornerCost find_cost(const CornerPlace& place, const std::pair<CornerEdge, CornerEdge>& edges, double window_s) {
  const ToolRates& rates = place.rates;
  const StrayBound& stray = place.stray;
  const PathEdge &first = edges.first.edge, &second = edges.second.edge;
  const Configuration turn = second.way - first.way, size = turn.cwiseAbs();
  CornerCost cost;
  cost.straight = size.maxCoeff() == 0;
  if (cost.straight) return cost;
  cost.turn = rates.turn.dot(size);
  cost.travel = rates.travel.dot(size);
  const double ball = (second.begin.ball - first.end.ball).norm(), top = (second.begin.top - first.end.top).norm(),
               travel = cost.travel, orders = rates.orders(2), longest = std::max(first.length, second.length);
  const double certain = stray.tool_m();
  Rooms rooms{certain, certain};
  const double all_links = stray.links(size);
  double links = std::max(all_links, stray.tool_and_links(place.point, place.above, size));
  const auto share_beside = [&](double turning) {
    return std::max({links, (ball + turning * travel) / rooms.ball, (top + turning * travel) / rooms.top});
  };
  const auto wanted = [&](double share) { return std::min(longest, 4 * max_parabola_share / share); };
  const double window = std::max(first.cap, second.cap) * window_s;
  if (const Rooms most = rooms_of(edges, window); most.ball > certain && most.top > certain) {
    rooms = most;
    links = std::max(all_links, stray.tool_and_links(place.point, true, size));
    const double half = std::min(wanted(share_beside(0)), std::min(first.length, second.length) / 2);
    const Rooms there = rooms_of(edges, window + half);
    cost.confined = there.ball > certain && there.top > certain;
    if (cost.confined) {
      rooms = there;
    } else {
      rooms = {certain, certain};
      links = std::max(links, stray.tool_and_links(place.point, place.above, size));
    }
  }
  const double guess = wanted(share_beside(0));
  const double turning = std::max(first.turn, second.turn) * guess + cost.turn * guess / 4;
  cost.share = share_beside(orders * turning);
  cost.tool_m = std::max(ball, top) + orders * turning * travel;
  cost.room_m = std::min(rooms.ball, rooms.top);
  cost.share_by_turn = orders * travel / cost.room_m;
  cost.wanted = wanted(cost.share);
  if (cost.confined) cost.wanted = std::min({cost.wanted, first.length / 2, second.length / 2});
  return cost;
}

}  // namespace sculpt
