#include "core/mill/rough/roughing.hpp"

#include <algorithm>

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

void hop(const Site& site, const Vec3& from, const Vec3& to, double least_height, std::vector<MillStroke>& strokes) {
  const ToolFrame& frame = site.frame();
  const double high = std::max({site.clear_height(from, to, air_clearance_m), from.z(), to.z(), least_height});
  const Vec3 over_from(from.x(), from.y(), high), over_to(to.x(), to.y(), high);
  // Beside what was cut the cutter may still touch it on its way up and down.
  const auto add = [&](const Vec3& at, bool cut) {
    strokes.push_back({frame.point(at), cut, cut ? cut_stray_m : air_stray_m});
  };
  if (high > from.z()) add(over_from, true);
  if ((over_to - over_from).norm() > 0) add(over_to, false);
  const double clear = std::clamp(site.clear_height(to, to, air_clearance_m), to.z(), high);
  if (clear < high) add({to.x(), to.y(), clear}, false);
  if (to.z() < clear) add(to, true);
}

std::vector<MillStroke> rough_level(const Site& site, const ClearingTask& level, double least_height, StockTop& surface,
                                    const Vec3& at) {
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
        hop(site, tip, begin, least_height, strokes);
      }
      for (std::size_t edge = 1; edge < pass->size(); ++edge)
        strokes.push_back({site.frame().point({(*pass)[edge].x(), (*pass)[edge].y(), height}), true, cut_stray_m});
      tip = {pass->back().x(), pass->back().y(), height};
    }
  } while (clearing.lower_threshold());
  return strokes;
}

}  // namespace sculpt
