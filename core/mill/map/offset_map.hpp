// Where a tool may be: what stands, as a height map -> the lowest heights of the tip (an inverse offset).
//
// A tip anywhere in cell c at height t is free if, for every other cell d, what stands there is no higher than the tool
// at the least distance of the two cells: t >= T(c), the maximum over d of H(d) less the tool's height there.
// What is above a point of the tool counts as part of it, so no more needs to be looked at than the top of each column.
// Both are bounds for whole cells: T is never too low.
#pragma once

#include "core/base/helpers.hpp"
#include "core/mill/map/assembly.hpp"
#include "core/mill/map/height_map.hpp"

namespace sculpt {

/// On all sides: with a larger radius and corner, and its tip that much lower.
Cutter grown_by(const Cutter& cutter, double more_m);

/// For the cutter, grown by `more_m` on all sides.
HeightMap offset_by_cutter(const HeightMap& stands, const Cutter& cutter, double more_m);

/// For the body above the cutter, grown by `more_m` on all sides; its rings on several threads where `helpers` are
/// given.
HeightMap offset_by_rings(const HeightMap& stands, const std::vector<Ring>& rings, double more_m,
                          const Helpers* helpers = nullptr);

/// Of each cell how low a cutter comes to all of it whose tip goes to the middle of every cell, as low as `limit` lets
/// it.
HeightMap lowest_cut(const HeightMap& limit, const Cutter& cutter);

}  // namespace sculpt
