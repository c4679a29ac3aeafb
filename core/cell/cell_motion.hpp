// The parts of a cell file that say how its joints may move and what a controller calls them. Internal to core/cell.
#pragma once

#include <vector>

#include "core/cell/cell_field.hpp"
#include "core/cell/controller/axis_map.hpp"
#include "core/cell/controller/joint_limits.hpp"
#include "core/cell/robot.hpp"

namespace sculpt {

/// The value of the field "limits": one entry for each joint of the robot, zeros for those that it does not name; a
/// velocity that it leaves out is the URDF's. Throws InputError `cell_invalid`.
std::vector<JointLimits> parse_limits(const Robot& robot, const CellField& limits);
/// What holds where the cell file has no such field: the URDF's velocities.
std::vector<JointLimits> limits_of_urdf(const Robot& robot);

/// The value of the field "programs". Throws InputError `cell_invalid`.
AxisMap parse_programs(const Robot& robot, const CellField& programs);

}  // namespace sculpt
