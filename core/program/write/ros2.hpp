// A plan as ROS 2 JointTrajectories: one, or one for each milling tool.
#pragma once

#include <functional>

#include "core/program/program_demands.hpp"
#include "core/program/write/part_writer.hpp"
#include "core/timing/timed_plan.hpp"

namespace sculpt {

/// Points where the acceleration changes, with velocities: a controller that goes on by cubics between them keeps the
/// law's lines exactly and its parabolas nearly.
ProgramReport write_ros2(const PlanPath& path, const Cell& cell, const ProgramDemands& demands,
                         const std::function<void(const ProgramFile&)>& take);

}  // namespace sculpt
