#include "core/mill/finish/contour_strokes.hpp"

#include <algorithm>
#include <tuple>

#include "core/mill/drive/hop.hpp"

namespace sculpt {
namespace {

/// A way along the surface may be so many times as long as straight.
constexpr double detour = 3;
/// Of a chip times radius: what may stand where the cutter is let down.
constexpr double max_plunged = 0.5;

}  // namespace

void ContourStrokes::lay(const Contour& contour, const Contour& way) {
  is_down_ = !way.empty();
  if (is_down_) add(way);
  add(contour);
}

Contour ContourStrokes::way_to(const Contour& contour) const {
  const Vec3& to = contour.front();
  const double far = (to - at_).norm();
  if (far > task_.beside_m) return {};
  Contour way = follow_whole(task_.envelope, at_.head<2>(), to.head<2>(), detour * far);
  if (!way.empty() && ((way.front() - at_).norm() > 1e-6 || (way.back() - to).norm() > 1e-6)) return {};
  return way;
}

void ContourStrokes::add(const Contour& contour) {
  const double radius_m = task_.radius_m;
  const auto lower = [&](const Vec3& from, const Vec3& to) { stock_.cut(from, to, [](std::size_t, float) {}); };
  for (std::size_t edge = 0; edge + 1 < contour.size(); ++edge) {
    const Vec3 &from = contour[edge], &to = contour[edge + 1];
    if (!is_down_) {
      const Vec3 above = from + Vec3(0, 0, radius_m);
      if (stock_.volume(above, from) > max_plunged * task_.chip_m2 * radius_m) continue;
      hop(task_.site, at_, from, std::max(from.z(), task_.min_height), task_.stray_m, strokes_);
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

std::vector<std::size_t> turn_nearest(const Vec3& at, std::vector<Contour>& contours, std::size_t some) {
  struct End {
    double far;
    std::size_t number;
    bool is_back;
  };
  std::vector<End> ends;
  for (std::size_t number = 0; number < contours.size(); ++number) {
    const double front = (contours[number].front() - at).squaredNorm(),
                 back = (contours[number].back() - at).squaredNorm();
    ends.push_back({std::min(front, back), number, back < front});
  }
  some = std::min(some, ends.size());
  std::ranges::partial_sort(ends, ends.begin() + static_cast<std::ptrdiff_t>(some), [](const End& a, const End& b) {
    return std::tie(a.far, a.number) < std::tie(b.far, b.number);
  });
  std::vector<std::size_t> nearest;
  for (std::size_t at_end = 0; at_end < some; ++at_end) {
    if (ends[at_end].is_back) std::ranges::reverse(contours[ends[at_end].number]);
    nearest.push_back(ends[at_end].number);
  }
  return nearest;
}

}  // namespace sculpt
