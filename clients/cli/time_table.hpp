// A timed plan as JSON and as a table.
#pragma once

#include <string>

#include "core/timing/timed_plan.hpp"
#include "proto/json.hpp"

namespace sculpt::cli {

/// {"time": {total_s, ratio, by{feed, rapid, velocity{}, acceleration{}, jerk{}}, worst[{keyframe, joint, feed_m_s}]}}.
Json time_report(const PlanPath& path, const TimedPlan& plan);
std::string time_table(const Json& report);

}  // namespace sculpt::cli
