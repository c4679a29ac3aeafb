// From one place over what stands to another.
#pragma once

#include <vector>

#include "core/mill/drive/mill_stroke.hpp"
#include "core/mill/map/site.hpp"

namespace sculpt {

/// How far the cutter may stray from a straight way in the air.
inline constexpr double air_stray_m = 5e-4;
/// What the tool keeps off things in the air, above and beside them.
inline constexpr double air_clearance_m = 2e-3, air_beside_m = air_stray_m + 1e-4;

/// Up, as a cut until the cutter is out of what stands and as a link from there on; over where all is clear, at no less
/// than `min_height`; and down to `to` in the same way (tool frame). Up to where it is clear, and from there down, the
/// cutter strays by no more than `stray_m`.
void hop(const Site& site, const Vec3& from, const Vec3& to, double min_height, double stray_m,
         std::vector<MillStroke>& strokes);

}  // namespace sculpt
