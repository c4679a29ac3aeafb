#include "core/solid/surface/sides.hpp"

#include <algorithm>

namespace sculpt {

std::vector<Side> sort_sides(const Triangles& triangles, std::size_t vertices) {
  std::vector<std::uint32_t> end(vertices + 1, 0);  // of each low vertex: first where its sides begin
  const auto low_of = [&](const std::array<std::uint32_t, 3>& t, int s) { return std::min(t[s], t[(s + 1) % 3]); };
  for (const auto& t : triangles)
    for (int s = 0; s < 3; ++s) ++end[low_of(t, s) + 1];
  for (std::size_t v = 1; v <= vertices; ++v) end[v] += end[v - 1];
  std::vector<Side> sides(3 * triangles.size());
  for (std::uint32_t facet = 0; facet < triangles.size(); ++facet)
    for (int s = 0; s < 3; ++s) {
      const auto& t = triangles[facet];
      const std::uint32_t low = low_of(t, s), high = std::max(t[s], t[(s + 1) % 3]);
      sides[end[low]++] = {low, high, facet, t[s] == low};
    }
  for (std::size_t first = 0, v = 0; v < vertices; first = end[v++])
    std::sort(sides.begin() + static_cast<std::ptrdiff_t>(first), sides.begin() + static_cast<std::ptrdiff_t>(end[v]),
              [](const Side& a, const Side& b) { return a.high != b.high ? a.high < b.high : a.facet < b.facet; });
  return sides;
}

}  // namespace sculpt
