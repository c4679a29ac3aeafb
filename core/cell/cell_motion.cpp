#include "core/cell/cell_motion.hpp"

#include <cmath>
#include <numbers>

namespace sculpt {
namespace {

using Field = CellField;

std::size_t find_moving_joint(const Robot& robot, const std::string& name, const std::string& pointer) {
  const int index = robot.find_joint(name);
  if (index < 0) {
    std::string names;
    for (const Joint& joint : robot.joints)
      if (joint.kind != JointKind::fixed && joint.mimic < 0) names += (names.empty() ? "" : ", ") + joint.name;
    refuse(pointer, "the URDF has no joint '" + name + "'; those that move are: " + names);
  }
  const Joint& joint = robot.joints[static_cast<std::size_t>(index)];
  if (joint.kind == JointKind::fixed) refuse(pointer, "joint '" + name + "' is fixed: leave it out");
  if (joint.mimic >= 0)
    refuse(pointer, "joint '" + name + "' follows '" + robot.joints[static_cast<std::size_t>(joint.mimic)].name +
                        "': give that one");
  return static_cast<std::size_t>(index);
}

// Of one joint; `unit` is its own, rad or m.
double limit(const Field& field, const std::string& unit) {
  const double value = field.number();
  if (!(value > 0) || !std::isfinite(value)) {
    std::ostringstream text;
    text << value << " is no limit: give what the maker publishes, above 0, in " << unit;
    refuse(field.pointer(), text.str());
  }
  return value;
}

JointLimits parse_joint_limits(const Joint& joint, const Field& field) {
  field.require_object({"velocity", "acceleration", "jerk"});
  const std::string unit = joint.kind == JointKind::revolute ? "rad" : "m";
  JointLimits limits{joint.max_speed, 0, 0};
  if (field.has("velocity")) limits.velocity = limit(field.at("velocity"), unit + "/s");
  if (limits.velocity == 0)
    refuse(field.pointer(),
           "no velocity, and the URDF has none for joint '" + joint.name + "': give it in " + unit + "/s");
  limits.acceleration = limit(field.at("acceleration"), unit + "/s^2");
  limits.jerk = limit(field.at("jerk"), unit + "/s^3");
  return limits;
}

const ControllerAxis* find_axis(const AxisMap& map, const std::string& name) {
  for (const ControllerAxis& axis : map.axes)
    if (axis.axis == name) return &axis;
  return nullptr;
}

ControllerAxis parse_axis(const Robot& robot, const Field& field) {
  field.require_object({"axis", "joint", "scale", "offset_deg", "offset_m"});
  ControllerAxis axis;
  axis.axis = field.at("axis").text();
  const Field joint = field.at("joint");
  axis.joint = static_cast<int>(find_moving_joint(robot, joint.text(), joint.pointer()));
  if (field.has("scale")) axis.scale = field.at("scale").number();
  if (axis.scale == 0 || !std::isfinite(axis.scale))
    refuse(field.pointer() + "/scale", "must be a number other than 0: 1, or -1 where the axis counts the other way");
  const bool turns = robot.joints[static_cast<std::size_t>(axis.joint)].kind == JointKind::revolute;
  if (field.has(turns ? "offset_m" : "offset_deg"))
    refuse(field.pointer(), std::string("the joint ") + (turns ? "turns: give offset_deg" : "shifts: give offset_m"));
  if (turns && field.has("offset_deg")) axis.offset = field.at("offset_deg").number() * std::numbers::pi / 180;
  if (!turns && field.has("offset_m")) axis.offset = field.at("offset_m").number();
  return axis;
}

AxisCoupling parse_coupling(const AxisMap& map, const Field& field) {
  field.require_object({"axis", "minus"});
  for (const char* part : {"axis", "minus"})
    if (find_axis(map, field.at(part).text()) == nullptr)
      refuse(field.at(part).pointer(), "no axis '" + field.at(part).text() + "' is in \"axes\"");
  AxisCoupling coupling{field.at("axis").text(), field.at("minus").text()};
  if (coupling.axis == coupling.minus) refuse(field.pointer(), "an axis less itself is nothing: name two axes");
  return coupling;
}

}  // namespace

std::vector<JointLimits> limits_of_urdf(const Robot& robot) {
  std::vector<JointLimits> limits;
  for (const Joint& joint : robot.joints) limits.push_back({joint.max_speed, 0, 0});
  return limits;
}

std::vector<JointLimits> parse_limits(const Robot& robot, const Field& field) {
  std::vector<JointLimits> limits = limits_of_urdf(robot);
  for (const auto& [name, value] : field.members()) {
    const std::size_t joint = find_moving_joint(robot, name, value.pointer());
    limits[joint] = parse_joint_limits(robot.joints[joint], value);
  }
  return limits;
}

AxisMap parse_programs(const Robot& robot, const Field& field) {
  field.require_object({"axes", "couple"});
  AxisMap map;
  for (const Field& each : field.at("axes").elements()) {
    ControllerAxis axis = parse_axis(robot, each);
    if (find_axis(map, axis.axis) != nullptr) refuse(each.pointer() + "/axis", "'" + axis.axis + "' is there already");
    for (const ControllerAxis& other : map.axes)
      if (other.joint == axis.joint)
        refuse(each.pointer() + "/joint", "this joint is axis '" + other.axis + "' already: a joint has one axis");
    map.axes.push_back(std::move(axis));
  }
  if (map.axes.empty()) refuse(field.at("axes").pointer(), "name at least one axis");
  map.couple_given = field.has("couple");
  if (map.couple_given)
    for (const Field& each : field.at("couple").elements()) map.couple.push_back(parse_coupling(map, each));
  return map;
}

}  // namespace sculpt
