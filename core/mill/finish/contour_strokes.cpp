#include "core/mill/finish/contour_strokes.hpp"

#include <algorithm>
#include <limits>

#include "core/mill/drive/hop.hpp"

namespace sculpt {
namespace {

/// A way along the surface may be so many times as long as straight.
constexpr double detour = 3;
/// Of a chip times radius: what may stand where the cutter is let down.
constexpr double most_plunged = 0.5;

}  // namespace

void ContourStrokes::lay(const Contour& contour) {
  const Contour way = is_down_ ? connect(contour.front()) : Contour{};
  is_down_ = !way.empty();
  if (is_down_) add(way);
  add(contour);
}

/// Along the surface; nothing where that is no short way.
Contour ContourStrokes::connect(const Vec3& to) const {
  const double far = (to - at_).norm();
  if (far > task_.beside_m) return {};
  std::vector<Contour> ways = follow_envelope(task_.envelope, at_.head<2>(), to.head<2>());
  if (ways.size() != 1) return {};
  Contour& way = ways.front();
  double length = 0;
  for (std::size_t at = 1; at < way.size(); ++at) length += (way[at] - way[at - 1]).norm();
  if (length > detour * far || (way.front() - at_).norm() > 1e-6 || (way.back() - to).norm() > 1e-6) return {};
  return std::move(way);
}

void ContourStrokes::add(const Contour& contour) {
  const double radius_m = task_.radius_m;
  const auto lower = [&](const Vec3& from, const Vec3& to) { stock_.cut(from, to, [](std::size_t, float) {}); };
  for (std::size_t edge = 0; edge + 1 < contour.size(); ++edge) {
    const Vec3 &from = contour[edge], &to = contour[edge + 1];
    if (!is_down_) {
      const Vec3 above = from + Vec3(0, 0, radius_m);
      if (stock_.volume(above, from) > most_plunged * task_.chip_m2 * radius_m) continue;
      hop(task_.site, at_, from, std::max(from.z(), task_.least_height), task_.stray_m, strokes_);
      lower(above, from);
      at_ = from;
      is_down_ = true;
    }
    if (stock_.volume(from, to) > task_.chip_m2 * std::max((to - from).norm(), radius_m / 4)) {
      is_down_ = false;
      continue;
    }
    lower(from, to);
    strokes_.push_back({task_.site.frame().point(to), true, task_.stray_m});
    at_ = to;
  }
}

std::size_t turn_nearest(const Vec3& at, std::vector<Contour>& contours) {
  double least = std::numeric_limits<double>::infinity();
  std::size_t nearest = 0;
  bool turned = false;
  for (std::size_t number = 0; number < contours.size(); ++number)
    for (const bool back : {false, true}) {
      const double far = ((back ? contours[number].back() : contours[number].front()) - at).squaredNorm();
      if (far >= least) continue;
      least = far;
      nearest = number;
      turned = back;
    }
  if (turned) std::ranges::reverse(contours[nearest]);
  return nearest;
}

}  // namespace sculpt
