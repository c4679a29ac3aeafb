// Bodies as a person calls them.
#pragma once

#include "core/collision/near_bodies.hpp"
#include "core/doctor/findings.hpp"

namespace sculpt {

/// A link's name, "the tool" or "the stock".
inline std::string body_name(const Robot& robot, int body) {
  if (body == NearBodies::stock) return "the stock";
  return body == NearBodies::tool ? "the tool" : robot.links[static_cast<std::size_t>(body)].name;
}

inline PairFinding name_bodies(const Robot& robot, int first, int second) {
  return {body_name(robot, first), body_name(robot, second)};
}

}  // namespace sculpt
