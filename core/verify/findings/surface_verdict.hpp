// How well a plan with milling tools leaves the surface.
#pragma once

#include <cstdint>
#include <vector>

namespace sculpt {

/// Measured along the outward normal at random points of the part.
struct SurfaceVerdict {
  std::vector<double> excess_m;     ///< of each: what stands above it; of those of its base nothing is said
  std::uint64_t base_points = 0;    ///< of the face that it stands on
  std::uint64_t gouged_points = 0;  ///< cut below by more than a micrometre
  double gouge_m = 0;               ///< the deepest of these cuts
};

}  // namespace sculpt
