#include "core/mill/drive/air_ways.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/mill/drive/hop.hpp"

namespace sculpt {
namespace {

/// Of the lattice, across and along the axis.
constexpr double column_m = 8e-3, layer_m = 6e-3;

/// Straight parts as one leg.
std::vector<Vec3> without_middles(const std::vector<Vec3>& way) {
  std::vector<Vec3> left;
  for (const Vec3& at : way) {
    while (left.size() > 1 && (left.back() - left[left.size() - 2]).cross(at - left.back()).norm() < 1e-9)
      left.pop_back();
    left.push_back(at);
  }
  return left;
}

}  // namespace

AirWays::AirWays(const Site& site, const ReachFloor& reach, const Vec3& from, double lowest,
                 const std::vector<Vec3>& refused)
    : site_(site), reach_(reach), from_(from) {
  const Lattice& all = site.lattice();
  const auto columns = [&](int cells) { return static_cast<int>(cells * all.step / column_m); };
  counts_ = {columns(all.width), columns(all.height), 1 + static_cast<int>(std::max(0.0, from.z() - lowest) / layer_m)};
  before_.assign(index({0, 0, counts_[2]}), unseen);
  number_.resize(before_.size());
  for (const Vec3& at : refused)
    if (const Cell cell = column(at, static_cast<int>(std::lround((from.z() - at.z()) / layer_m))); is_inside(cell))
      before_[index(cell)] = closed;
  begin();
  for (std::int32_t next = 0; next < static_cast<std::int32_t>(line_.size()); ++next) look_around(next);
}

bool AirWays::is_free(const Vec3& at) const {
  return reach_.allows(at) && is_clear(at, at);
}

bool AirWays::is_clear(const Vec3& a, const Vec3& b) const {
  return site_.clear_height(a, b, air_clearance_m, air_beside_m) <= a.z();
}

Vec3 AirWays::middle(const Cell& cell) const {
  return {site_.lattice().low_u + (cell[0] + 0.5) * column_m, site_.lattice().low_v + (cell[1] + 0.5) * column_m,
          from_.z() - cell[2] * layer_m};
}

bool AirWays::is_inside(const Cell& cell) const {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (cell[axis] < 0 || cell[axis] >= counts_[axis]) return false;
  return true;
}

std::size_t AirWays::index(const Cell& cell) const {
  const auto at = [&](std::size_t axis) { return static_cast<std::size_t>(cell[axis]); };
  return (at(2) * static_cast<std::size_t>(counts_[1]) + at(1)) * static_cast<std::size_t>(counts_[0]) + at(0);
}

AirWays::Cell AirWays::column(const Vec3& at, int layer) const {
  return {static_cast<int>(std::floor((at.x() - site_.lattice().low_u) / column_m)),
          static_cast<int>(std::floor((at.y() - site_.lattice().low_v) / column_m)), layer};
}

/// Straight down from the beginning, and over to the columns around it.
void AirWays::begin() {
  for (int layer = 0; layer < counts_[2]; ++layer) {
    const Vec3 below(from_.x(), from_.y(), from_.z() - layer * layer_m);
    if (!is_free(below)) return;
    const Cell own = column(below, layer);
    for (int db = -1; db <= 1; ++db)
      for (int da = -1; da <= 1; ++da) look({own[0] + da, own[1] + db, layer}, below, at_begin);
  }
}

void AirWays::look(const Cell& cell, const Vec3& from, std::int32_t number) {
  if (!is_inside(cell) || before_[index(cell)] != unseen) return;
  const Vec3 at = middle(cell);
  if (!is_free(at) || (at.z() == from.z() && !is_clear(from, at))) return;
  before_[index(cell)] = number;
  number_[index(cell)] = static_cast<std::int32_t>(line_.size());
  line_.push_back(cell);
}

void AirWays::look_around(std::int32_t number) {
  const Cell cell = line_[static_cast<std::size_t>(number)];
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int step : {-1, 1}) {
      Cell beside = cell;
      beside[axis] += step;
      look(beside, middle(cell), number);
    }
}

std::vector<Vec3> AirWays::to(const Vec3& to) const {
  // The first that was come to of those beside its column.
  std::int32_t first = std::numeric_limits<std::int32_t>::max();
  for (int layer = 0; layer < counts_[2]; ++layer) {
    const Cell cell = column(to, layer);
    if (!is_inside(cell) || before_[index(cell)] < at_begin) continue;
    const Vec3 above(to.x(), to.y(), middle(cell).z());
    if (is_free(above) && is_clear(middle(cell), above)) first = std::min(first, number_[index(cell)]);
  }
  if (first == std::numeric_limits<std::int32_t>::max()) return {};
  std::vector<Vec3> way{{to.x(), to.y(), middle(line_[static_cast<std::size_t>(first)]).z()}};
  for (std::int32_t number = first; number != at_begin;) {
    const Cell& cell = line_[static_cast<std::size_t>(number)];
    way.push_back(middle(cell));
    number = before_[index(cell)];
  }
  way.emplace_back(from_.x(), from_.y(), way.back().z());
  std::ranges::reverse(way);
  return without_middles(way);
}

}  // namespace sculpt
