#include "core/timing/demand/motion_order.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/base/error.hpp"
#include "core/timing/demand/motion_limits.hpp"

namespace sculpt {

MotionDemands demands_of(const MotionOrder& order, const std::vector<MillTool>& tools) {
  if (!order.feed_m_s && tools.empty())
    throw InputError("feed_invalid", "a thin tool has no feed of its own: give one in m/s, for example 0.05");
  MotionDemands demands{order.feed_m_s.value_or(0), order.rapid_m_s, order.keep_feed, 0};
  if (!order.feed_m_s)
    for (const MillTool& tool : tools) demands.feed_m_s = std::max(demands.feed_m_s, tool.feed_m_s);
  check_demands(demands);
  return demands;
}

void check_order(const MotionOrder& order, const Cell& cell, const std::vector<MillTool>& tools) {
  demands_of(order, tools);
  limits_of(cell, cell.chain());
}

void check_demands(const MotionDemands& demands) {
  const auto refuse = [](const char* what, double value, const char* rest) {
    std::ostringstream text;
    text << "a " << what << " of " << value << rest;
    throw InputError("feed_invalid", text.str());
  };
  const auto is_speed = [](double value) { return value > 0 && std::isfinite(value); };
  constexpr const char* unmoved = " m/s cannot be moved at: give one above 0";
  if (!is_speed(demands.feed_m_s)) refuse("feed", demands.feed_m_s, unmoved);
  if (!is_speed(demands.rapid_m_s)) refuse("rapid rate", demands.rapid_m_s, unmoved);
  if (demands.keep_feed && !(*demands.keep_feed > 0 && *demands.keep_feed <= 1))
    refuse("share of the feed", *demands.keep_feed, " cannot be kept: give one above 0, and 1 at most");
}

}  // namespace sculpt
