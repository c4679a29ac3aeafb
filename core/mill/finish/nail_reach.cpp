#include "core/mill/finish/nail_reach.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace sculpt {
namespace {

/// Lattices for what is above the cutter: cells of its radius, and of the block's side at most.
constexpr double cells_a_radius = 16, cells_a_side = 300;
/// Of the tolerance: a nail counts as reached where the cutter would leave no more, the allowance aside.
constexpr double reached_share = 1.0 / 3;
/// A ball at rest on a nail is looked at a little smaller, so that the nail itself is not in its way.
constexpr double rest_slack_m = 1e-6;
/// Of the nails, so many are asked for on a square of the stepover.
constexpr double asked_a_stepover = 1.6;
/// Beside a nail: of how far a ball may rest on its plane and still leave the tolerance; each in so many ways.
constexpr std::array beside_shares{0.4, 0.9};
constexpr int turns_beside = 5;
/// Of the tolerance, what may be left beside a nail: where it is more than all of it, points around come within it.
constexpr double beside_tolerance_share = 1.5;
/// Where a ball pushed off a nail leaves so many times as much, those pushed off beside it are not looked at.
constexpr double hopeless = 4;
/// A place beside a nail is worth going to for so much.
constexpr double gain_m = 5e-6;
/// Places no farther apart than this are one.
constexpr double same_place_m = 3e-5;
constexpr std::size_t nails_a_batch = 512;
/// A surface that looks away from a direction more than this (cosine) is not asked for along it.
constexpr double least_cosine = -0.02;

std::size_t stride_of(const MillJob& job, double radius_m, const Nails& nails) {
  const double needed_m2 = std::pow(job.wishes.stepover_m(radius_m), 2) / asked_a_stepover;
  return std::max<std::size_t>(1, static_cast<std::size_t>(needed_m2 / nails.area_m2()));
}

}  // namespace

bool is_above_floor(const Site& site, const Vec3& tip) {
  const int a = site.lattice().cell_u(tip.x()), b = site.lattice().cell_v(tip.y());
  return site.lattice().contains(a, b) && site.floor(a, b) <= tip.z();
}

NailReach::NailReach(const MillJob& job, PartViews& views, Carver& carver, bool is_last, const RunContext& run)
    : job_(job),
      views_(views),
      carver_(carver),
      run_(run),
      nails_(carver.nails()),
      radius_m_(carver.tool().cutter.radius_m),
      stride_(is_last ? 1 : stride_of(job, radius_m_, nails_)),
      along_(nails_.size()),
      aside_(nails_.size(), Eigen::Vector3f::Zero()),
      leaves_(nails_.size()) {
  for (const Direction& direction : mill_directions()) frames_.emplace_back(direction);
  sites_.resize(frames_.size());
}

Site& NailReach::site(std::size_t direction) {
  if (!sites_[direction])
    sites_[direction] =
        carver_.make_site(direction, {job_.wishes.allowance_m + job_.wishes.stray_m(), body_margin_m},
                          std::max(job_.grid.n * job_.grid.voxel_m / cells_a_side, radius_m_ / cells_a_radius));
  return *sites_[direction];
}

Vec3 NailReach::middle_at(const Place& place, const ToolFrame& frame) const {
  const Nail& nail = nails_[place.nail];
  return frame.of(nail.point + (radius_m_ + job_.wishes.allowance_m) * nail.normal + place.aside);
}

void NailReach::find() {
  std::vector<Place> places;
  for (std::size_t nail = 0; nail < nails_.size(); nail += stride_)
    if (is_open(nail)) places.push_back({nail, Vec3::Zero(), 0});
  const std::vector<std::uint32_t> found = look_along_all(places, reached_m());
  for (std::size_t at = 0; at < places.size(); ++at) {
    const std::size_t nail = places[at].nail;
    along_[nail] |= found[at];
    if (along_[nail] != 0) carver_.mark_reachable(nail);
  }
}

std::vector<std::uint32_t> NailReach::come_to(const std::vector<std::uint32_t>& nails, std::size_t direction) {
  std::vector<Place> places;
  places.reserve(nails.size());
  for (const std::uint32_t nail : nails) places.push_back({nail, Vec3::Zero(), 0});
  std::vector<std::uint32_t> asked(nails.size());
  std::iota(asked.begin(), asked.end(), 0);
  keep_reached(asked, places, reached_m(), direction);
  std::vector<std::uint32_t> reached;
  reached.reserve(asked.size());
  for (const std::uint32_t at : asked) reached.push_back(nails[at]);
  return reached;
}

double NailReach::reached_m() const {
  return job_.wishes.allowance_m + reached_share * job_.wishes.tolerance_m;
}

double NailReach::most_left_m() const {
  return beside_tolerance_share * job_.wishes.tolerance_m + gain_m;
}

/// Of each place along which directions the cutter comes to it and leaves no more than `most_m`: a bit each.
std::vector<std::uint32_t> NailReach::look_along_all(const std::vector<Place>& places, double most_m) {
  std::vector<std::vector<std::uint32_t>> found(frames_.size());
  run_.helpers.for_each_index(frames_.size(), [&](std::size_t direction) {
    for (std::uint32_t at = 0; at < places.size(); ++at)
      if (cosine(places[at].nail, direction) >= least_cosine) found[direction].push_back(at);
    keep_reached(found[direction], places, most_m, direction);
  });
  std::vector<std::uint32_t> along(places.size());
  for (std::size_t direction = 0; direction < found.size(); ++direction)
    for (const std::uint32_t at : found[direction]) along[at] |= std::uint32_t{1} << direction;
  return along;
}

void NailReach::keep_reached(std::vector<std::uint32_t>& asked, const std::vector<Place>& places, double most_m,
                             std::size_t direction) {
  if (asked.empty()) return;
  const Site& here = site(direction);
  const auto columns = views_.along(direction, frames_[direction]);
  std::vector<char> is_reached(asked.size());
  run_.helpers.for_each_index((asked.size() + nails_a_batch - 1) / nails_a_batch, [&](std::size_t batch) {
    if (run_.watch.stop.stop_requested()) throw Cancelled{};
    for (std::size_t at = batch * nails_a_batch; at < std::min(asked.size(), (batch + 1) * nails_a_batch); ++at)
      is_reached[at] = leaves_no_more(most_m, places[asked[at]], here, *columns);
  });
  std::size_t looked_at = 0;
  std::erase_if(asked, [&](std::uint32_t) { return is_reached[looked_at++] == 0; });
}

/// Does a cutter at rest leave no more of what stands on a nail? No where it may not be.
bool NailReach::leaves_no_more(double most_m, const Place& place, const Site& site, const FacetColumns& columns) const {
  const auto& [nail, aside, leaves] = place;
  const Vec3 middle = middle_at(place, site.frame());
  if (!is_above_floor(site, middle - Vec3(0, 0, radius_m_))) return false;
  const Vec3 normal = site.frame().of(nails_[nail].normal);
  const double height = columns.rest_height(
      middle.x(), middle.y(), radius_m_ + job_.wishes.allowance_m - rest_slack_m, middle.z() - rest_slack_m,
      middle.z() + highest_above(aside.norm(), most_m, normal.z()) + rest_slack_m);
  return way_to_ball(site.frame().of(nails_[nail].point), normal, {middle.x(), middle.y(), height}, radius_m_) <=
         most_m;
}

/// Raised more than this above its place on a nail or beside it, a ball leaves more than `most_m`. Along the normal its
/// middle is r + allowance + d cos from the nail, across it d sin and what it is aside; it leaves `most_m` where
/// (r + allowance - most_m + d cos)^2 + (d sin - aside)^2 = r^2.
double NailReach::highest_above(double aside, double most_m, double cosine) const {
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const double along = radius_m_ + job_.wishes.allowance_m - most_m;
  const double half = along * cosine - sine * aside,
               root = half * half - along * along - aside * aside + radius_m_ * radius_m_;
  return root < 0 ? std::numeric_limits<double>::infinity() : std::sqrt(root) - half;
}

void NailReach::find_beside() {
  const std::vector<Place> places = free_places();
  const double most_m = beside_tolerance_share * job_.wishes.tolerance_m;
  const std::vector<std::uint32_t> found = look_along_all(places, most_m);
  // Of a nail's places the one that it is come to along most directions.
  for (std::size_t at = 0; at < places.size(); ++at) {
    const auto& [nail, aside, leaves] = places[at];
    const auto merit = [&](std::uint32_t along, double left) {
      return std::pair(along != 0 && left <= job_.wishes.tolerance_m, std::popcount(along));
    };
    const float left = leaves + static_cast<float>(gain_m);
    if (merit(found[at], leaves) <= merit(along_[nail], leaves_[nail] - gain_m)) continue;
    along_[nail] = found[at];
    aside_[nail] = aside.cast<float>();
    leaves_[nail] = left;
  }
}

/// Where a ball that the part alone is in the way of leaves less, of open nails that nothing was found for; in the
/// order of nails.
std::vector<NailReach::Place> NailReach::free_places() const {
  const FreeBall ball(job_.part);
  std::vector<std::vector<Place>> found((nails_.size() + nails_a_batch - 1) / nails_a_batch);
  run_.helpers.for_each_index(found.size(), [&](std::size_t batch) {
    for (std::size_t nail = batch * nails_a_batch; nail < std::min(nails_.size(), (batch + 1) * nails_a_batch);
         ++nail) {
      if (run_.watch.stop.stop_requested()) throw Cancelled{};
      if (nail % stride_ == 0 && is_open(nail) && along_[nail] == 0) add_free_places(nail, ball, found[batch]);
    }
  });
  std::vector<Place> places;
  for (const auto& each : found) places.insert(places.end(), each.begin(), each.end());
  return places;
}

void NailReach::add_free_places(std::size_t nail, const FreeBall& ball, std::vector<Place>& places) const {
  const Vec3 &point = nails_[nail].point, &normal = nails_[nail].normal;
  const double radius = radius_m_ + job_.wishes.allowance_m,
               far = std::sqrt(2 * radius_m_ * std::max(0.0, job_.wishes.tolerance_m - job_.wishes.allowance_m));
  const Vec3 side = normal.unitOrthogonal(), other = normal.cross(side), rest = point + radius * normal;
  const double most_m = beside_tolerance_share * job_.wishes.tolerance_m;
  const std::size_t first = places.size();
  // What it leaves; infinite where it is not free.
  const auto add = [&](const Vec3& start) {
    const auto middle = ball.push_out(start, radius);
    if (!middle) return std::numeric_limits<double>::infinity();
    const double leaves = way_to_ball(point, normal, *middle, radius_m_ - job_.wishes.stray_m());
    const Vec3 aside = *middle - rest;
    const bool is_known = std::any_of(places.begin() + static_cast<std::ptrdiff_t>(first), places.end(),
                                      [&](const Place& place) { return (place.aside - aside).norm() < same_place_m; });
    if (!is_known && leaves <= most_m && leaves + gain_m < nails_.excess(nail))
      places.push_back({nail, aside, static_cast<float>(leaves)});
    return leaves;
  };
  // Where it may be on the nail itself not the part is in the way, but what is above the cutter.
  const double pushed_off = add(rest);
  if (pushed_off <= job_.wishes.allowance_m + job_.wishes.stray_m() + gain_m || pushed_off > hopeless * most_m) return;
  for (const double share : beside_shares)
    for (int turn = 0; turn < turns_beside; ++turn) {
      const double angle = 2 * std::numbers::pi * turn / turns_beside;
      add(rest + share * far * (std::cos(angle) * side + std::sin(angle) * other));
    }
}

}  // namespace sculpt
