// Where a dialect's digits are few: which of the numbers that it can write are best.
#pragma once

#include "core/program/axis_layout.hpp"
#include "core/timing/edge.hpp"

namespace sculpt {

/// Axes (rad or m) as the controller reads them where they are written with so many decimals of degrees or millimetres.
Configuration nearest_axes(const AxisLayout& layout, Configuration axes, int decimals);

/// Axes (rad or m, as the controller counts them) that have no more than so many decimals in degrees or millimetres,
/// none more than one and a half steps from where it is at `q`: of those, about the ones with which ball and shank's
/// end are least beside where they are at `q`. What one axis rounds away another one makes up for. The nearest ones
/// where a joint would be past its limit.
Configuration round_axes(const AxisLayout& layout, const ToolRates& rates, const Configuration& q, int decimals);

}  // namespace sculpt
