// What hangs on what in a Robot.
#pragma once

#include "core/cell/robot.hpp"

namespace sculpt {

/// Does the link hang below the joint, does the joint carry it about?
inline bool carries(const Robot& robot, int joint, int link) {
  while (link >= 0) {
    const int above = robot.links[static_cast<std::size_t>(link)].parent_joint;
    if (above == joint) return true;
    link = above < 0 ? -1 : robot.joints[static_cast<std::size_t>(above)].parent_link;
  }
  return false;
}

}  // namespace sculpt
