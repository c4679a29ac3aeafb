// How far it is over a surface.
#pragma once

#include <vector>

#include "core/mill/finish/rows/plan_patch.hpp"

namespace sculpt {

/// Of the middle of each cell to the nearest that is a source, along the surface (m): over cells inside of a patch as
/// it slopes there, elsewhere over level ground. No source, no distance: infinite. Solves |grad d| = 1 in the metric of
/// the surface by fast marching, with stencils from Selling's decomposition of its inverse, so that values come in
/// ascending order on steep surfaces too (Mirebeau, "Riemannian fast-marching on Cartesian grids, using Voronoi's first
/// reduction of quadratic forms", SIAM J. Numer. Anal. 57, 2019).
std::vector<float> surface_distances(const PlanPatch& patch, const std::vector<char>& is_source);

}  // namespace sculpt
