#include "core/timing/window_corners.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/square.hpp"

namespace sculpt {

void WindowCorners::add(const CornerCost& cost, double at, double speed) {
  corners_[count_++] = {&cost, at};
  turn_change_ += cost.turn * speed;
  travel_change_ += cost.travel * speed;
  room_m_ = std::min(room_m_, cost.room_m);
  left = std::min(left, 1 - cost.parabola);
}

void WindowCorners::add_edge(const PathEdge& edge, double speed) {
  acceleration = std::max(acceleration, edge.line_acceleration);
  turn_speed = std::max(turn_speed, edge.turn * speed);
  travel_speed_ = std::max(travel_speed_, edge.travel * speed);
  fastest_ = std::max(fastest_, speed);
  add_rise(edge, edge);
}

void WindowCorners::add_rise(const PathEdge& first, const PathEdge& second) {
  const double rise = std::max(first.line_acceleration, second.line_acceleration);
  turn_rise_ = std::max(turn_rise_, rise * std::max(first.turn, second.turn));
  travel_rise_ = std::max(travel_rise_, rise * std::max(first.travel, second.travel));
}

/// Of a displacement at one of them.
double WindowCorners::share(const CornerCost& cost, double turned) const {
  return std::max(cost.share, cost.tool_m / room_m_) + turned * cost.share_by_turn * cost.room_m / room_m_;
}

/// Of all where the window's mean is there, each weighed.
double WindowCorners::share_at(double mean, double reach, double turned) const {
  double sum = 0;
  for (std::size_t at = 0; at < count_; ++at) {
    const auto& [cost, place] = corners_[at];
    const double beyond = std::abs(mean - place) - cost->wanted;
    if (beyond <= 0)
      sum += share(*cost, turned);
    else if (beyond < reach)
      sum += square(1 - beyond / reach) * share(*cost, turned);
  }
  return sum;
}

/// Between ends of parabolas and of the first one's reach the sum is convex in the place of the mean.
double WindowCorners::max_share(double turned, double window_s) const {
  const double reach = fastest_ * window_s / 2, first_reach = corners_[0].cost->wanted + reach;
  double most = std::max(share_at(first_reach, reach, turned), share_at(-first_reach, reach, turned));
  for (std::size_t at = 0; at < count_; ++at)
    for (const double side : {-1, 1})
      if (const double end = corners_[at].at + side * corners_[at].cost->wanted; std::abs(end) < first_reach)
        most = std::max(most, share_at(end, reach, turned));
  return most;
}

double WindowCorners::feed_change(double window_s, const ToolRates& rates) const {
  constexpr double mean_square = 7.0 / 60;  // of (1 - 2 x + 2 x^2) / 2
  const double turn = std::min(turn_change_ + window_s * turn_rise_, 2 * turn_speed),
               travel = std::min(travel_change_ + window_s * travel_rise_, 2 * travel_speed_);
  const double first = turn * travel_speed_ + (rates.chain.shifts() ? travel * turn_speed : 0),
               rest = rates.orders(3) * mean_square / 2 * square(window_s * turn_speed) * travel_speed_;
  return window_s / 8 * first + rest;
}

}  // namespace sculpt
