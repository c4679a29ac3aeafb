// How fast a plan is wished to be gone through, before it is known which tools it has.
#pragma once

#include <vector>

#include "core/cell/cell.hpp"
#include "core/cell/milling/mill_tool.hpp"
#include "core/timing/demand/motion_demands.hpp"

namespace sculpt {

/// Meaning as in MotionDemands.
struct MotionOrder {
  std::optional<double> feed_m_s = {};  ///< without it that of the fastest milling tool
  double rapid_m_s = 0.5;
  std::optional<double> keep_feed = {};
};

/// `tools`: those that the plan mills with; none for a thin tool. Throws InputError `feed_invalid` for what is no feed,
/// no rate or no share, and where neither the order nor a tool has a feed.
MotionDemands demands_of(const MotionOrder& order, const std::vector<MillTool>& tools);

/// What time_plan would refuse whatever the plan: throws InputError `limits_missing`, and as demands_of.
void check_order(const MotionOrder& order, const Cell& cell, const std::vector<MillTool>& tools);

}  // namespace sculpt
