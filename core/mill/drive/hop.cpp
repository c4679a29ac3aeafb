#include "core/mill/drive/hop.hpp"

#include <algorithm>

namespace sculpt {
namespace {

/// Besides what it strays: what the cutter keeps off what stands where it goes up from there.
constexpr double beside_clearance_m = 1e-4;

/// Over a place: from where on the cutter touches nothing more, and from where on it may stray. Heights, neither lower
/// than the place.
struct Rise {
  double free = 0, clear = 0;
};

Rise rise(const Site& site, const Vec3& at, double stray_m, double high) {
  const double most = std::max(at.z(), high);
  const double clear = std::clamp(site.clear_height(at, at, air_clearance_m, air_beside_m), at.z(), most);
  return {std::clamp(site.free_height(at, stray_m + beside_clearance_m), at.z(), clear), clear};
}

}  // namespace

void hop(const Site& site, const Vec3& from, const Vec3& to, double min_height, double stray_m,
         std::vector<MillStroke>& strokes) {
  const double high = std::max(site.clear_height(from, to, air_clearance_m, air_beside_m), min_height);
  const auto add = [&](const Vec3& at, double height, bool cut, double stray) {
    strokes.push_back({site.frame().point({at.x(), at.y(), height}), cut, stray});
  };
  const Rise up = rise(site, from, stray_m, high), down = rise(site, to, stray_m, high);
  if (up.free > from.z()) add(from, up.free, true, stray_m);
  if (up.clear > up.free) add(from, up.clear, false, stray_m);
  if (high != up.clear) add(from, high, false, air_stray_m);
  if ((to - from).head<2>().norm() > 0) add(to, high, false, air_stray_m);
  if (down.clear != high) add(to, down.clear, false, air_stray_m);
  if (down.clear > down.free) add(to, down.free, false, stray_m);
  if (to.z() < down.free) add(to, to.z(), true, stray_m);
}

}  // namespace sculpt
