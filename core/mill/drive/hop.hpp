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

/// Up to where the way over is clear of everything, or down from above it; over, at no less than `min_height`; and on
/// to `to` (tool frame): so near what could be there it strays by no more than `stray_m`.
void hop(const Site& site, const Vec3& from, const Vec3& to, double min_height, double stray_m,
         std::vector<MillStroke>& strokes);

}  // namespace sculpt
