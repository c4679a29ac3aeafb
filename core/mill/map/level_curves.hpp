// Curves along which a field over a lattice has one value.
#pragma once

#include <vector>

#include "core/mill/map/height_map.hpp"

namespace sculpt {

using Curve = std::vector<Point2>;

/// `field`: at the middles of cells, linear in between. What is larger lies on the left of a curve; a closed one ends
/// where it begins. By marching squares (Lorensen, Cline, "Marching cubes", SIGGRAPH 1987, in the plane).
std::vector<Curve> level_curves(const std::vector<float>& field, const Lattice& lattice, double value);

}  // namespace sculpt
