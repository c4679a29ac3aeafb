// Random machines in which parts move close to each other by design, and a check of plans for them that shares nothing
// with the planner or the replay: own kinematics, boxes only, dense samples.
#pragma once

#include <string>
#include <vector>

#include "core/base/frame.hpp"
#include "core/cell/cell.hpp"

namespace sculpt {

/// Upright in the frame of its part; metres.
struct Brick {
  Vec3 centre, half;
};

/// A link of such a machine and the joint that it hangs on. Its frame: the parent's, moved to `at`, turned upside down
/// if `flipped`, then moved or turned by the joint.
struct MachinePart {
  enum class Move { fixed, slide, hinge };
  std::string name;
  int parent = -1;
  Move joint = Move::fixed;
  Vec3 at = Vec3::Zero();
  bool flipped = false;
  Vec3 axis = Vec3::UnitZ();
  double low = 0, high = 0, home = 0;
  std::vector<Brick> bricks = {};
};

/// The stock stands on part 0; the tool sits in the last part and sticks out along its z.
struct TightMachine {
  std::string title;
  std::vector<MachinePart> parts;
  double stock_m = 0.1, stickout_m = 0.2, tool_radius_m = 0;

  /// Machines that only slide are the paper's: a ball without a shank.
  bool has_shank() const;
  CellFiles files() const;
};

/// A gantry, maybe with a head that turns, with one or more of: a ram in a hole of a fixed plate, a peg that dips into
/// a sleeve, a fork around a post, slides nested in each other.
TightMachine random_tight_machine(std::uint64_t seed, int resolution);

/// Where a trajectory (ndjson) makes two parts of the machine, or the tool and a part, overlap that are apart at home;
/// empty if nowhere, as far as samples show that are at most 0.5 mm of motion apart.
std::string find_overlap(const TightMachine& machine, const std::string& trajectory);

}  // namespace sculpt
