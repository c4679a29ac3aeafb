// A tour's contours -> those that are worth the way (a profitable tour: Feillet, Dejax, Gendreau, "Traveling salesman
// problems with profits", Transportation Science 39, 2005).
#pragma once

#include <cstddef>
#include <vector>

#include "core/mill/finish/envelope.hpp"

namespace sculpt {

/// Which contours of a tour are kept, in their order, so that what all of these are worth, less their lengths and the
/// ways between them, is most. `worth_m`: of each contour, the path that it is worth. `far_m`: no way from one to the
/// next counts as longer; half of it is the way to the first one and from the last one.
std::vector<std::size_t> profitable(const std::vector<Contour>& tour, const std::vector<double>& worth_m, double far_m);

}  // namespace sculpt
