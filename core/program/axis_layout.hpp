// Joints of a plan -> axes of a controller.
#pragma once

#include <string>
#include <vector>

#include "core/cell/cell.hpp"
#include "core/program/dialect.hpp"

namespace sculpt {

/// The axes in the order in which the dialect writes them: robot axes 1 to 6, then external ones; letters of G-code as
/// the cell has them; joints by their own names for ROS.
struct AxisLayout {
  struct Axis {
    std::string name;
    Eigen::Index coordinate;  ///< of the plan
    double scale, offset;
    bool turns;
    Eigen::Index minus = -1;  ///< the axis that it is written less, by number in this layout
  };
  std::vector<Axis> axes;
  std::size_t robot_axes = 0;  ///< the first so many; the others are external

  /// rad or m, as the controller counts them.
  Configuration to_axes(const Configuration& q) const;
  Configuration to_joints(const Configuration& axes) const;
};

/// Throws InputError `axes_unfit` that says which joint or axis does not fit the dialect, and the cure.
AxisLayout lay_out_axes(const Cell& cell, const Chain& chain, Dialect dialect);

}  // namespace sculpt
