// From one place over what stands to another.
#pragma once

#include <vector>

#include "core/mill/drive/mill_stroke.hpp"
#include "core/mill/map/site.hpp"

namespace sculpt {

/// What the tool keeps off things in the air.
inline constexpr double air_clearance_m = 2e-3;

/// Up, over and down to `to` (tool frame) as far as that is clear of everything, then on as if something could be
/// there: so near it strays by no more than `stray_m`. Over at no less than `min_height`.
void hop(const Site& site, const Vec3& from, const Vec3& to, double min_height, double stray_m,
         std::vector<MillStroke>& strokes);

}  // namespace sculpt
