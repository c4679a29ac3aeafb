#include "core/mill/finish/tour/tour.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/mill/finish/tour/arcs.hpp"
#include "core/mill/finish/tour/short_order.hpp"

namespace sculpt {

std::vector<Contour> tour_of(const std::vector<Contour>& contours, double near_m) {
  const std::vector<Contour> arcs = cut_where_near(contours, near_m);
  if (arcs.empty()) return {};
  std::vector<Contour> tour;
  for (const std::uint32_t end : short_order(arcs)) {
    Contour next = arcs[end / 2];
    if (end % 2 == 1) std::ranges::reverse(next);
    if (!tour.empty() && tour.back().back() == next.front())
      tour.back().insert(tour.back().end(), next.begin() + 1, next.end());
    else
      tour.push_back(std::move(next));
  }
  return tour;
}

}  // namespace sculpt
