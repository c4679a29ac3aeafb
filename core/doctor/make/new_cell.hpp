// A maker's URDF -> a cell that can be planned with: a tool on its flange, a table in front of it, a home.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/doctor/findings.hpp"

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

struct NewCell {
  std::string urdf;                  ///< the maker's, with what was added
  Cell cell;                         ///< as these texts say
  std::vector<std::string> remarks;  ///< what was assumed, a sentence each
  bool has_home = false;             ///< else its home is no more than joints at 0
};

/// Where nothing is wished: tool_link the flange, the stock an eighth of the arm's length, a tool a little longer than
/// the stock, a spindle of its size, a table where most of the stock is reached of 16 places in front of the arm.
/// Throws InputError (`urdf_invalid`, `cell_invalid`), Cancelled.
NewCell make_cell(const MakersRobot& robot, const CellWishes& wishes, const RunContext& run);

/// The cell file. `urdf`: its path from the cell file; `packages`: folders by the names of ROS packages.
std::string cell_text(const Cell& cell, const std::string& urdf, const std::map<std::string, std::string>& packages);

}  // namespace sculpt
