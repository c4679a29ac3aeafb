#include "core/mill/finish/nail_reach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sculpt {
namespace {

/// Lattices for what is above the cutter: cells of its radius, and no finer than this.
constexpr double cells_a_radius = 8, finest_cell_m = 8e-4;
/// The body keeps that much more off than it may stray.
constexpr double body_room_m = 1e-4;
/// Of the tolerance: a nail counts as reached where the cutter would leave no more, the allowance aside.
constexpr double reached_share = 1.0 / 3;
/// A ball at rest on a nail is looked at a little smaller, so that the nail itself is not in its way.
constexpr double rest_slack_m = 1e-6;
/// Beside a nail: of how far a ball may rest on its plane and still leave the tolerance; and in so many ways.
constexpr double beside_share = 0.6;
constexpr int turns_beside = 6;
constexpr std::size_t nails_a_batch = 512;

}  // namespace

bool is_above_floor(const Site& site, const Vec3& tip) {
  const int a = site.lattice().cell_u(tip.x()), b = site.lattice().cell_v(tip.y());
  return site.lattice().contains(a, b) && site.floor(a, b) <= tip.z();
}

NailReach::NailReach(const MillJob& job, PartViews& views, Carver& carver, const RunContext& run)
    : job_(job),
      views_(views),
      carver_(carver),
      run_(run),
      nails_(carver.nails()),
      radius_m_(carver.tool().cutter.radius_m),
      along_(nails_.size()),
      aside_(nails_.size(), Eigen::Vector3f::Zero()) {
  for (const Direction& direction : mill_directions()) frames_.emplace_back(direction);
  sites_.resize(frames_.size());
}

Site& NailReach::site(std::size_t direction) {
  if (!sites_[direction])
    sites_[direction] =
        carver_.make_site(direction, {job_.wishes.allowance_m + job_.wishes.stray_m(), body_stray_m + body_room_m},
                          std::max(finest_cell_m, radius_m_ / cells_a_radius));
  return *sites_[direction];
}

Vec3 NailReach::middle_over(std::size_t nail, const ToolFrame& frame) const {
  return frame.of(nails_[nail].point + (radius_m_ + job_.wishes.allowance_m) * nails_[nail].normal +
                  aside_[nail].cast<double>());
}

void NailReach::find(double below, double from) {
  std::vector<std::vector<char>> found(frames_.size());
  run_.helpers.for_each_index(frames_.size(), [&](std::size_t direction) {
    const Site& here = site(direction);
    const auto columns = views_.along(direction, frames_[direction]);
    found[direction].resize(nails_.size());
    for (std::size_t nail = 0; nail < nails_.size(); ++nail) {
      const double along = cosine(nail, direction);
      if (along < below && along >= from && is_open(nail)) found[direction][nail] = is_reached(nail, here, *columns);
      if (nail % nails_a_batch == 0 && run_.watch.stop.stop_requested()) throw Cancelled{};
    }
  });
  for (std::size_t nail = 0; nail < nails_.size(); ++nail) {
    for (std::size_t direction = 0; direction < found.size(); ++direction)
      along_[nail] |= static_cast<std::uint32_t>(found[direction][nail]) << direction;
    if (along_[nail] != 0) carver_.mark_reachable(nail);
  }
}

bool NailReach::is_reached(std::size_t nail, const Site& site, const FacetColumns& columns) const {
  return leaves_no_more(job_.wishes.allowance_m + reached_share * job_.wishes.tolerance_m, nail, site, columns);
}

/// Does a cutter at rest leave no more of what stands on a nail? No where it may not be.
bool NailReach::leaves_no_more(double most_m, std::size_t nail, const Site& site, const FacetColumns& columns) const {
  const Vec3 middle = middle_over(nail, site.frame());
  if (!is_above_floor(site, middle - Vec3(0, 0, radius_m_))) return false;
  const Vec3 normal = site.frame().of(nails_[nail].normal);
  const double height = columns.rest_height(middle.x(), middle.y(), radius_m_ + job_.wishes.allowance_m - rest_slack_m,
                                            middle.z() - rest_slack_m,
                                            middle.z() + highest_above(nail, most_m, normal.z()) + rest_slack_m);
  return way_to_ball(site.frame().of(nails_[nail].point), normal, {middle.x(), middle.y(), height}, radius_m_) <=
         most_m;
}

/// Raised more than this above its place on a nail or beside it, a ball leaves more than `most_m`. Along the normal its
/// middle is r + allowance + d cos from the nail, across it d sin and what it is aside; it leaves `most_m` where
/// (r + allowance - most_m + d cos)^2 + (d sin - aside)^2 = r^2.
double NailReach::highest_above(std::size_t nail, double most_m, double cosine) const {
  const double aside = static_cast<double>(aside_[nail].norm()), sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const double along = radius_m_ + job_.wishes.allowance_m - most_m;
  const double half = along * cosine - sine * aside,
               root = half * half - along * along - aside * aside + radius_m_ * radius_m_;
  return root < 0 ? std::numeric_limits<double>::infinity() : std::sqrt(root) - half;
}

void NailReach::find_beside(double from) {
  Views columns;
  for (std::size_t direction = 0; direction < frames_.size(); ++direction) {
    site(direction);
    columns.push_back(views_.along(direction, frames_[direction]));
  }
  const double far = beside_share * std::sqrt(2 * radius_m_ * (job_.wishes.tolerance_m - job_.wishes.allowance_m));
  run_.helpers.for_each_index((nails_.size() + nails_a_batch - 1) / nails_a_batch, [&](std::size_t batch) {
    if (run_.watch.stop.stop_requested()) throw Cancelled{};
    for (std::size_t nail = batch * nails_a_batch; nail < std::min(nails_.size(), (batch + 1) * nails_a_batch); ++nail)
      if (is_open(nail) && along_[nail] == 0) find_beside(nail, from, far, columns);
  });
}

void NailReach::find_beside(std::size_t nail, double from, double far, const Views& columns) {
  const Vec3 side = nails_[nail].normal.unitOrthogonal(), other = nails_[nail].normal.cross(side);
  for (int turn = 0; turn < turns_beside && along_[nail] == 0; ++turn) {
    const double angle = 2 * std::numbers::pi * turn / turns_beside;
    aside_[nail] = (far * (std::cos(angle) * side + std::sin(angle) * other)).cast<float>();
    for (std::size_t direction = 0; direction < frames_.size(); ++direction)
      if (cosine(nail, direction) >= from &&
          leaves_no_more(job_.wishes.tolerance_m, nail, *sites_[direction], *columns[direction]))
        along_[nail] |= std::uint32_t{1} << direction;
  }
  if (along_[nail] == 0) aside_[nail].setZero();
}

}  // namespace sculpt
