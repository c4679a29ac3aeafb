#include "core/mill/drive/hop.hpp"

#include <algorithm>

namespace sculpt {
void hop(const Site& site, const Vec3& from, const Vec3& to, double min_height, double stray_m,
         std::vector<MillStroke>& strokes) {
  const ToolFrame& frame = site.frame();
  const double high = std::max(site.clear_height(from, to, air_clearance_m), min_height);
  const Vec3 over_from(from.x(), from.y(), high), over_to(to.x(), to.y(), high);
  // Beside what was cut the cutter may still touch it on its way up and down.
  const auto add = [&](const Vec3& at, bool cut) {
    strokes.push_back({frame.point(at), cut, cut ? stray_m : air_stray_m});
  };
  const double free = std::clamp(site.clear_height(from, from, air_clearance_m), from.z(), std::max(from.z(), high));
  if (free > from.z()) add({from.x(), from.y(), free}, true);
  if (high != free) add(over_from, false);
  if ((over_to - over_from).norm() > 0) add(over_to, false);
  const double clear = std::clamp(site.clear_height(to, to, air_clearance_m), to.z(), std::max(to.z(), high));
  if (clear != high) add({to.x(), to.y(), clear}, false);
  if (to.z() < clear) add(to, true);
}

}  // namespace sculpt
