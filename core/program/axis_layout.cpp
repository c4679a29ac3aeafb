#include "core/program/axis_layout.hpp"

#include <algorithm>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

[[noreturn]] void refuse(Dialect dialect, const std::string& why) {
  throw InputError("axes_unfit",
                   std::string("no ") + facts_of(dialect).name + " program can be written for this cell: " + why);
}

const ControllerAxis& axis_of(const Cell& cell, int joint, Dialect dialect) {
  for (const ControllerAxis& axis : cell.programs.axes)
    if (axis.joint == joint) return axis;
  refuse(dialect, "joint '" + cell.robot.joints[static_cast<std::size_t>(joint)].name +
                      "' has no axis: give it one in \"programs\": {\"axes\": [...]} of the cell file");
}

/// A1, J1: robot axis 1; E1: external axis 1. 0 where the name is not of that kind.
struct AxisNumber {
  int robot = 0, external = 0;
};
AxisNumber number_of(const std::string& name) {
  if (name.size() != 2 || name[1] < '1' || name[1] > '6') return {};
  const int number = name[1] - '0';
  if (name[0] == 'A' || name[0] == 'J') return {number, 0};
  if (name[0] == 'E') return {0, number};
  return {};
}

int rank_of(const std::string& name, Dialect dialect) {
  const AxisNumber number = number_of(name);
  const DialectFacts& facts = facts_of(dialect);
  if (number.robot > 0) return number.robot;
  if (number.external > 0 && static_cast<std::size_t>(number.external) <= facts.external_axes)
    return 6 + number.external;
  refuse(dialect,
         "it has no axis '" + name + "'" +
             (facts.external_axes == 0 ? ": it moves six joints of one arm and nothing else, the stock must stand still"
                                       : ": name robot axes A1 to A6 (or J1 to J6) and external ones E1 to E" +
                                             std::to_string(facts.external_axes)));
}

}  // namespace

Configuration AxisLayout::to_axes(const Configuration& q) const {
  Configuration values(static_cast<Eigen::Index>(axes.size()));
  for (std::size_t at = 0; at < axes.size(); ++at)
    values[static_cast<Eigen::Index>(at)] = axes[at].scale * q[axes[at].coordinate] + axes[at].offset;
  Configuration shown = values;
  for (std::size_t at = 0; at < axes.size(); ++at)
    if (axes[at].minus >= 0) shown[static_cast<Eigen::Index>(at)] -= values[axes[at].minus];
  return shown;
}

Configuration AxisLayout::to_joints(const Configuration& shown) const {
  Configuration values = shown, q(static_cast<Eigen::Index>(axes.size()));
  for (std::size_t at = 0; at < axes.size(); ++at)
    if (axes[at].minus >= 0)
      values[static_cast<Eigen::Index>(at)] = shown[static_cast<Eigen::Index>(at)] + shown[axes[at].minus];
  for (std::size_t at = 0; at < axes.size(); ++at)
    q[axes[at].coordinate] = (values[static_cast<Eigen::Index>(at)] - axes[at].offset) / axes[at].scale;
  return q;
}

AxisLayout lay_out_axes(const Cell& cell, const Chain& chain, Dialect dialect) {
  const DialectFacts& facts = facts_of(dialect);
  AxisLayout layout;
  for (Eigen::Index coordinate = 0; coordinate < chain.dof(); ++coordinate) {
    const int joint = chain.joints()[static_cast<std::size_t>(coordinate)];
    const Joint& own = cell.robot.joints[static_cast<std::size_t>(joint)];
    const bool turns = own.kind == JointKind::revolute;
    if (dialect == Dialect::ros2) {
      layout.axes.push_back({own.name, coordinate, 1, 0, turns});
      continue;
    }
    const ControllerAxis& axis = axis_of(cell, joint, dialect);
    layout.axes.push_back({axis.axis, coordinate, axis.scale, axis.offset, turns});
  }
  if (dialect == Dialect::ros2) {
    layout.robot_axes = layout.axes.size();
    return layout;
  }
  if (dialect == Dialect::gcode) {
    for (const AxisLayout::Axis& axis : layout.axes)
      if (axis.name.size() != 1 || std::string("XYZABCUVW").find(axis.name[0]) == std::string::npos)
        refuse(dialect, "axis '" + axis.name + "' is none of X, Y, Z, A, B, C, U, V, W: name it so in the cell file");
    layout.robot_axes = layout.axes.size();
  } else {
    std::ranges::stable_sort(layout.axes, {},
                             [&](const AxisLayout::Axis& axis) { return rank_of(axis.name, dialect); });
    for (AxisLayout::Axis& axis : layout.axes) {
      const int rank = rank_of(axis.name, dialect);
      layout.robot_axes += rank <= 6;
      if (rank <= 6 && !axis.turns) refuse(dialect, "robot axis '" + axis.name + "' shifts: only external axes may");
    }
    if (facts.needs_six && layout.robot_axes != 6)
      refuse(dialect, "its chain has " + std::to_string(layout.robot_axes) + " robot axes and " +
                          std::to_string(layout.axes.size()) +
                          " joints, the dialect moves an arm of six: take another dialect (ros2 takes any chain)");
    for (std::size_t at = layout.robot_axes; at < layout.axes.size(); ++at)
      if (static_cast<std::size_t>(rank_of(layout.axes[at].name, dialect)) != 7 + at - layout.robot_axes)
        refuse(dialect, "external axes are counted from E1 on without a gap");
  }
  for (const AxisCoupling& coupling : cell.programs.couple)
    for (std::size_t at = 0; at < layout.axes.size(); ++at)
      for (std::size_t other = 0; other < layout.axes.size(); ++other)
        if (layout.axes[at].name == coupling.axis && layout.axes[other].name == coupling.minus) {
          layout.axes[at].minus = static_cast<Eigen::Index>(other);
          if (layout.axes[other].minus >= 0) refuse(dialect, "an axis that is coupled itself is taken off another one");
        }
  if (dialect == Dialect::fanuc && !cell.programs.couple_given)
    refuse(dialect,
           "a FANUC arm shows its J3 against the ground: say \"couple\": [{\"axis\": \"J3\", \"minus\": \"J2\"}], or "
           "\"couple\": [] for an arm that does not");
  return layout;
}

}  // namespace sculpt
