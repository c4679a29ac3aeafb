// How a controller names and counts the joints of a cell.
#pragma once

#include <string>
#include <vector>

namespace sculpt {

/// value of the axis = scale * joint + offset; rad or m.
struct ControllerAxis {
  std::string axis;  ///< as the controller calls it, e.g. A1
  int joint = -1;    ///< of the robot
  double scale = 1, offset = 0;
};

/// The controller shows `axis` less `minus`: Fanuc counts its J3 against the ground.
struct AxisCoupling {
  std::string axis, minus;
};

/// Linear, so what is straight in the joints is straight in the axes.
struct AxisMap {
  std::vector<ControllerAxis> axes;
  std::vector<AxisCoupling> couple;
  bool couple_given = false;  ///< also where it says that there is none
};

}  // namespace sculpt
