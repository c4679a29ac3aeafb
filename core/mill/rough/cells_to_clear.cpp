#include "core/mill/rough/cells_to_clear.hpp"

#include <algorithm>
#include <numbers>

#include "core/mill/rough/cell_distances.hpp"

namespace sculpt {

CellsToClear find_cells_to_clear(const Cutter& cutter, double height, double cusp_m, const std::vector<char>& is_free,
                                 const HeightMap& tops, const Helpers& helpers) {
  const Lattice& lattice = tops.lattice;
  CellsToClear cells{std::vector<char>(lattice.size())};
  const auto stands_above = static_cast<float>(height + cusp_m);
  if (std::ranges::none_of(tops.heights, [&](float top) { return top > stands_above; })) return cells;
  const std::vector<float> to_free = distances_to(is_free, lattice, &helpers);
  const double to_corner = std::numbers::sqrt2 * lattice.step;
  double heights = 0;
  for (std::size_t at = 0; at < cells.marked.size(); ++at) {
    if (tops.heights[at] <= stands_above) continue;
    const double r = static_cast<double>(to_free[at]) + to_corner, top = static_cast<double>(tops.heights[at]);
    if (r >= cutter.radius_m || top - cutter.height_m(r) <= static_cast<double>(stands_above)) continue;
    cells.marked[at] = 1;
    heights += top - height;
  }
  cells.volume_m3 = heights * lattice.step * lattice.step;
  return cells;
}

}  // namespace sculpt
