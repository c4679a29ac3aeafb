// What the digits of a dialect cost: how far they have tool and links beside the plan. Internal to core/program.
#pragma once

#include <string>
#include <utility>

#include "core/program/axis_layout.hpp"
#include "core/timing/path_tool.hpp"

namespace sculpt {

/// Where a program stops, as it is planned.
struct ProgramPlace {
  Configuration q;
  std::size_t point;  ///< of the path: there, or where its retreat begins
  const PathTool& tool;
};

/// Other joints than the plan's at a place: by how much, and as shares of what its certificates leave.
struct DigitStray {
  Configuration size;
  double tool_m, tool, links;
};

/// Nothing but digits strays in a program that stops at every keyframe. Layout and path must outlive this.
class Digits {
 public:
  Digits(Dialect dialect, const AxisLayout& layout, const PlanPath& path)
      : dialect_(dialect), layout_(layout), path_(path) {}

  /// What is to be written; where the nearest numbers of the dialect would have the tool too far off, others.
  Configuration axes_at(const ProgramPlace& place) const;

  /// A place, and what follows for each move from one to the next, is free if both its ends are within what is left.
  /// Both throw InputError `rounding_too_coarse` else, with the keyframe. `read`: joints as the controller has them.
  DigitStray check_place(const ProgramPlace& place, const Configuration& read) const;
  using End = std::pair<const ProgramPlace&, const DigitStray&>;
  void check_move(const End& from, const End& to) const;

 private:
  DigitStray stray_at(const ProgramPlace& place, const Configuration& q) const;
  double certain_m(const ProgramPlace& place) const;
  void check_share(double share, const std::string& what, const ProgramPlace& place) const;

  Dialect dialect_;
  const AxisLayout& layout_;
  const PlanPath& path_;
};

}  // namespace sculpt
