// Milling tools as they can be bought: a cutter, and what holds it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/cell/tool.hpp"

namespace sculpt {

/// The shape of a cutter's end. A bull-nose cutter is flat with a rounded rim.
enum class CutterKind { ball, bull, flat };

/// "ball", "bull", "flat".
const char* name(CutterKind kind);

/// What cuts: from the tip up, as high as the flutes go.
struct Cutter {
  CutterKind kind = CutterKind::ball;
  double radius_m = 0;
  double corner_radius_m = 0;  ///< of the rim: the radius of a ball, 0 of a flat cutter
  double flute_m = 0;          ///< length of the flutes, the end included

  /// How high above the tip the surface is at a distance `r_m` from the axis, of 0 up to the radius.
  double height_m(double r_m) const;
};

/// Turns about its axis, so it is the same from all sides.
struct MillTool {
  std::string name;
  int number = 0;  ///< its place in the magazine
  Cutter cutter;
  std::vector<HolderSection> body;  ///< neck, shank, holder: from the top of the flutes up
  double stickout_m = 0;            ///< from the tool link's origin to the tip
  double max_depth_m = 0;           ///< of cut, along the axis
  double max_width_m = 0;           ///< of cut, across it
  double feed_m_s = 0;
  std::optional<double> plunge_m_s;
  std::optional<double> spindle_rpm;
};

}  // namespace sculpt
