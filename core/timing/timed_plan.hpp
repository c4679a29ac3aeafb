// Plan and cell -> the time law, and what it costs.
#pragma once

#include <optional>
#include <stop_token>
#include <string>

#include "core/cell/cell.hpp"
#include "core/law/time_law.hpp"
#include "core/timing/demand/motion_demands.hpp"
#include "core/timing/plan_path.hpp"
#include "core/timing/slow_places.hpp"
#include "core/timing/time_account.hpp"

namespace sculpt {

struct TimedPlan {
  TimeLaw law;
  TimeAccount time;
  std::vector<SlowPlace> worst;  ///< ten at most, the slowest first, none twice
};

/// Throws InputError `cell_mismatch` for a plan of another cell.
void check_cell(const PlanPath& path, const Chain& chain, const Cell& cell);

/// The shortest law for these demands that keeps velocity, acceleration and jerk of all joints, and stays as near to
/// the plan's edges as their certificates allow (StrayBound, corners.hpp). Of cuts one after the other along one line
/// of the grid the first and the last voxel do not count for `keep_feed`: there the motion comes to rest or turns.
/// Throws InputError: `feed_invalid` for a demand that is no positive number, or too small, `limits_missing`,
/// `reserve_invalid`, `feed_not_kept`, `cell_mismatch` for a plan of another cell; Cancelled soon after a stop was
/// requested. Depends on its arguments only.
TimedPlan time_plan(const PlanPath& path, const Cell& cell, const MotionDemands& demands,
                    const std::stop_token& stop = {});

}  // namespace sculpt
