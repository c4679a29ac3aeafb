#include "core/mill/finish/contour_strokes.hpp"

#include <algorithm>
#include <array>
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
/// Of the depth of cut: how much higher it goes over what is too much at once.
constexpr std::array layer_shares{0.25, 0.5, 1.0};

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

/// Volume (m^3); adds to what is taken.
double ContourStrokes::take(const Vec3& from, const Vec3& to) {
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
  taken_.clear();
  const double plunged_m3 = take(above, to);
  if (plunged_m3 > max_plunged_m3(task_.tool, task_.voxel_m)) {
    stock_.give_back(taken_);
    return false;
  }
  hop(task_.site, at_, to, std::max(to.z(), task_.min_height), task_.stray_m, strokes_);
  at_ = to;
  is_down_ = true;
  load_.begin(plunged_m3);
  return true;
}

/// As far as the cutter bears it at once, the rest in layers.
void ContourStrokes::cut(const Vec3& to) {
  const Vec3 from = at_;
  const double shortest = shortest_share * task_.tool.cutter.radius_m / (to - from).norm();
  for (double share = 0, step = 1; share < 1;) {
    const double next = std::min(1.0, share + step);
    if (go({at_, next < 1 ? Vec3(from + next * (to - from)) : to})) {
      share = next;
    } else if (step /= 2; step < shortest) {
      is_down_ = cut_in_layers(to);
      return;
    }
  }
}

/// Rising to above it first, and back: so that the cutter takes off a part of it each time.
bool ContourStrokes::cut_in_layers(const Vec3& to) {
  return std::ranges::any_of(layer_shares, [&](double share) {
    const Vec3 up(0, 0, share * task_.tool.max_depth_m);
    return go({at_, at_ + up, to + up, at_, to});
  });
}

/// All of the way, or nothing where that is more than the cutter bears.
bool ContourStrokes::go(const Contour& way) {
  ChipLoad load = load_;
  taken_.clear();
  for (std::size_t edge = 0; edge + 1 < way.size(); ++edge) {
    const Vec3 &from = way[edge], &to = way[edge + 1];
    if (load.bears(take(from, to), (to - from).norm())) continue;
    stock_.give_back(taken_);
    return false;
  }
  load_ = std::move(load);
  for (auto place = way.begin() + 1; place != way.end(); ++place)
    strokes_.push_back({task_.site.frame().point(*place), true, task_.stray_m});
  at_ = way.back();
  return true;
}

void ContourStrokes::add(const Contour& contour) {
  for (std::size_t edge = 0; edge + 1 < contour.size(); ++edge)
    if (is_down_ || let_down(contour[edge])) cut(contour[edge + 1]);
}

}  // namespace sculpt
