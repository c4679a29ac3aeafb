// What a new cell is made of: a maker's robot, and what is wished.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/cell/cell.hpp"

namespace sculpt {

enum class Table { turntable, fixed, none };  ///< none: the URDF has a link that the stock stands on

/// What of a new cell is decided; the rest is found. Metres.
struct CellWishes {
  std::string tool_link;  ///< empty: the end of the longest row of joints
  std::string stock_link;
  std::optional<double> stock_size_m, stickout_m;
  std::optional<double> spindle_radius_m, spindle_length_m;  ///< a length of 0: none is added
  std::optional<double> ball_radius_m;                       ///< of ball and shank; else they follow the voxels
  Table table = Table::turntable;
  std::optional<Vec3> table_at_m;  ///< the middle of its top, in the frame of the URDF's root
  std::optional<double> table_radius_m;
  bool floor = true;
};

/// A robot as its maker gives it. `read_mesh` returns the bytes of a mesh that the URDF names, or throws InputError.
struct MakersRobot {
  std::string urdf;
  std::function<std::string(const std::string& reference)> read_mesh;
};

}  // namespace sculpt
