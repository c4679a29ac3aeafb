// A straight way of a milling tool's tip.
#pragma once

#include "core/base/frame.hpp"

namespace sculpt {

/// From where the last one ended, the axis held as it is.
struct MillStroke {
  Vec3 tip_m;          ///< where it ends (stock frame)
  bool cut = false;    ///< may take off material
  double stray_m = 0;  ///< how far a point of the cutter may be from where a straight motion has it
};

}  // namespace sculpt
