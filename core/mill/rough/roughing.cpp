#include "core/mill/rough/roughing.hpp"

#include <algorithm>

#include "core/mill/drive/hop.hpp"

namespace sculpt {
std::vector<char> free_cells(const Site& site, double height, const IsReachable& reachable) {
  const Lattice& lattice = site.lattice();
  std::vector<char> free(lattice.size());
  for (int b = 0; b < lattice.height; ++b)
    for (int a = 0; a < lattice.width; ++a) {
      const std::size_t at = lattice.index(a, b);
      const auto limit = static_cast<double>(std::max(site.limit().heights[at], site.body_limit().heights[at]));
      free[at] = limit <= height && reachable({lattice.u(a), lattice.v(b), height});
    }
  return free;
}

std::vector<MillStroke> rough_level(const Site& site, const ClearingTask& level, double least_height, double stray_m,
                                    StockTop& surface, const Vec3& at) {
  std::vector<MillStroke> strokes;
  const double height = level.height;
  Clearing clearing(level, surface);
  if (clearing.volume_to_clear() < least_pass_m3(level.tool)) return strokes;
  Vec3 tip = at;
  do {
    for (;;) {
      std::optional<LevelPass> pass;
      if (tip.z() == height) pass = clearing.next_from(tip.head<2>());
      if (!pass) {
        const auto entry = clearing.find_entry(tip.head<2>());
        if (!entry) break;
        pass = clearing.next_from(*entry);
        if (!pass) continue;
        const Vec3 begin(entry->x(), entry->y(), height);
        hop(site, tip, begin, least_height, stray_m, strokes);
      }
      for (std::size_t edge = 1; edge < pass->size(); ++edge)
        strokes.push_back({site.frame().point({(*pass)[edge].x(), (*pass)[edge].y(), height}), true, stray_m});
      tip = {pass->back().x(), pass->back().y(), height};
    }
  } while (clearing.lower_threshold());
  return strokes;
}

}  // namespace sculpt
