// One move of a program, as it is to be written and as it was read back.
#pragma once

#include "core/base/frame.hpp"

namespace sculpt {

/// All joints linearly from where they are to `axes`, coming to rest there.
struct ProgramMove {
  Configuration axes;  ///< as the controller counts them; rad or m
  double seconds = 0;  ///< from rest to rest; at least so many
  /// Largest share of an axis's velocity, for dialects that say a speed and no time.
  double share = 0;
};

}  // namespace sculpt
