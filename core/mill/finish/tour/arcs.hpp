// Contours cut into arcs where one can go over to another.
#pragma once

#include <vector>

#include "core/mill/finish/envelope.hpp"

namespace sculpt {

/// Those that come no farther than `near_m` are joined, the nearest first, by a tree (Kruskal), and cut where its edges
/// touch them. A ring that nothing touches is one arc.
std::vector<Contour> cut_where_near(const std::vector<Contour>& contours, double near_m);

}  // namespace sculpt
