// A maker's URDF -> a cell that can be planned with: a tool on its flange, a table in front of it, a home.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/doctor/make/cell_wishes.hpp"

namespace sculpt {

struct NewCell {
  std::string urdf;                  ///< the maker's, with what was added
  Cell cell;                         ///< as these texts say
  std::vector<std::string> remarks;  ///< what was assumed, a sentence each
  bool has_home = false;             ///< else its home is no more than joints at 0
};

/// Where nothing is wished: tool_link the flange, the stock a seventh of the arm's length, a tool a little longer than
/// the stock, a spindle of its size, a table where most of the stock is reached of some places in front of the arm, or
/// below one that hangs.
/// Throws InputError (`urdf_invalid`, `cell_invalid`), Cancelled.
NewCell make_cell(const MakersRobot& robot, const CellWishes& wishes, const RunContext& run);

/// The cell file. `urdf`: its path from the cell file; `packages`: folders by the names of ROS packages.
std::string cell_text(const Cell& cell, const std::string& urdf, const std::map<std::string, std::string>& packages);

}  // namespace sculpt
