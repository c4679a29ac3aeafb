// In which order contours are gone along, and from which end.
#pragma once

#include <vector>

#include "core/mill/finish/envelope.hpp"

namespace sculpt {

/// The same contours, cut where others come no farther than `near_m`, turned and put in an order so that ways from the
/// end of one to the beginning of the next are short; parts that follow each other as they did are one.
std::vector<Contour> tour_of(const std::vector<Contour>& contours, double near_m);

}  // namespace sculpt
