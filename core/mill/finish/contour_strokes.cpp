#include "core/mill/finish/contour_strokes.hpp"

#include <algorithm>
#include <cmath>

#include "core/mill/drive/hop.hpp"

namespace sculpt {
namespace {

/// A way along the surface may be so many times as long as straight.
constexpr double detour = 3;
/// Where something is in the way on the surface it is gone over, where that is no longer; in steps (radii).
constexpr double longest_over = 8, over_step = 0.25;
/// Of the radius: an edge is cut in part in steps no shorter.
constexpr double shortest_share = 1.0 / 16;

}  // namespace

void ContourStrokes::lay(const Contour& contour, const Contour& way, const std::vector<Vec3>& air) {
  has_laid_ = true;
  is_down_ = !way.empty();
  if (is_down_) add(way);
  if (!air.empty()) go_by_air(air);
  add(contour);
}

Contour ContourStrokes::way_to(const Vec3& to) const {
  const double far = (to - at_).norm();
  if (far > task_.beside_m) return {};
  Contour way = follow_whole(task_.envelope, at_.head<2>(), to.head<2>(), detour * far);
  if (way.empty()) return way_over(to);
  if ((way.front() - at_).norm() > 1e-6 || (way.back() - to).norm() > 1e-6) return {};
  return way;
}

/// Up, straight over what is in the way, and down; nothing where that is far.
Contour ContourStrokes::way_over(const Vec3& to) const {
  const double radius = task_.envelope.radius_m, step = over_step * radius;
  for (double height = std::max(at_.z(), to.z()) + step;; height += step) {
    const Vec3 from_top(at_.x(), at_.y(), height), to_top(to.x(), to.y(), height);
    Contour way{at_, from_top, to_top, to};
    if (length_m(way) > longest_over * radius) return {};
    if (may_go(task_.envelope, from_top, to_top)) return way;
  }
}

/// Volume (m^3).
double ContourStrokes::take(const Vec3& from, const Vec3& to) {
  taken_.clear();
  const auto quanta = [&](const Vec3& tip) { return quanta_of(task_.site.frame().point(tip)); };
  return stock_.take(task_.swept, quanta(from), quanta(to), &taken_) * std::pow(task_.voxel_m, 3);
}

void ContourStrokes::go_by_air(const std::vector<Vec3>& air) {
  hop(task_.site, at_, air.front(), air.front().z(), task_.stray_m, strokes_);
  for (const Vec3& place : air) strokes_.push_back({task_.site.frame().point(place), false, air_stray_m});
  at_ = air.back();
}

/// From above, if little stands there.
bool ContourStrokes::let_down(const Vec3& to) {
  const Vec3 above = to + Vec3(0, 0, task_.tool.cutter.radius_m);
  if (take(above, to) > max_plunged_m3(task_.tool, task_.voxel_m)) {
    stock_.give_back(taken_);
    return false;
  }
  hop(task_.site, at_, to, std::max(to.z(), task_.min_height), task_.stray_m, strokes_);
  at_ = to;
  is_down_ = true;
  load_.begin();
  return true;
}

/// As far as the cutter bears it.
void ContourStrokes::cut(const Vec3& to) {
  const Vec3 from = at_;
  const double length = (to - from).norm(), shortest = shortest_share * task_.tool.cutter.radius_m / length;
  double share = 0;
  for (double step = 1; share < 1;) {
    const double next = std::min(1.0, share + step);
    const Vec3 end = next < 1 ? Vec3(from + next * (to - from)) : to;
    if (load_.bears(take(at_, end), (next - share) * length)) {
      share = next;
      at_ = end;
      continue;
    }
    stock_.give_back(taken_);
    is_down_ = step / 2 >= shortest;
    if (!is_down_) break;
    step /= 2;
  }
  if (share > 0) strokes_.push_back({task_.site.frame().point(at_), true, task_.stray_m});
}

void ContourStrokes::add(const Contour& contour) {
  for (std::size_t edge = 0; edge + 1 < contour.size(); ++edge)
    if (is_down_ || let_down(contour[edge])) cut(contour[edge + 1]);
}

}  // namespace sculpt
