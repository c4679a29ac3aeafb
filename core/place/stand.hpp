// Where table or base of a cell stands, how high its block and how long its tool: what a study of stands varies.
#pragma once

#include <optional>
#include <string>

#include "core/cell/cell.hpp"

namespace sculpt {

/// Metres and radians.
struct Stand {
  Vec3 at_m = Vec3::Zero();  ///< origin of the moved joint in its parent link's frame
  double turn_rad = 0;    ///< about the parent link's z through that origin, beside how the joint is turned in the URDF
  double height_m = 0;    ///< of the grid's floor over the stock link's origin: z of `stock.origin_m`
  double stickout_m = 0;  ///< of the tool
  bool operator==(const Stand&) const = default;
};

/// What is moved: all that hangs below one joint, seen from all that does not.
enum class Moved { table, base };

/// The joint whose origin is changed to move a cell's table or base, by number. The ways from the root to the stock and
/// to the tool part at some link. `table`: on the stock's way from there, the first joint that moves, else the first.
/// `base`: on the tool's way, the last fixed joint before the first that turns, if any moves beyond it; else the first
/// joint if that shifts. Throws InputError `cell_invalid` where there is no such joint.
int find_moved_joint(const Cell& cell, Moved moved);

/// The joint of this name. Throws InputError `cell_invalid` unless moving it moves the stock against the tool.
int find_moved_joint(const Cell& cell, const std::string& name);

/// As it stands in the cell.
Stand stand_of(const Cell& cell, int joint);

/// The origin that the joint has at the stand.
Frame origin_at(const Robot& robot, int joint, const Stand& stand);

/// The cell with this stand and nothing else changed; `urdf` is empty. Throws InputError `cell_invalid` where the tool
/// is no longer than its holder.
Cell cell_at(const Cell& cell, int joint, const Stand& stand);

}  // namespace sculpt
