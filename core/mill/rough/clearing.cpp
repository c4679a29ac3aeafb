#include "core/mill/rough/clearing.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/mill/rough/ramp.hpp"
#include "core/mill/rough/row_entries.hpp"

namespace sculpt {
namespace {

/// Of the cutter's radius: how long an edge is.
constexpr double step_share = 0.8;
/// Of a width of cut: from row to row.
constexpr double row_share = 1.04;
/// Of depth times width of cut: what may be taken off, and over a diameter; by whole voxels it may look like more.
constexpr double cap_share = 1.01, window_share = 1.05;
/// Of what may be taken off over a diameter: at once. Edges are weighed in so many bits a radius.
constexpr double burst_share = 0.12, bits_a_radius = 16;
/// Of that a row uses up no more where it goes farther inside than it need.
constexpr double used_inside = 0.5;
/// Of what may be taken off over a radius, where a pass begins.
constexpr double little_share = 0.05;
/// Of what may be taken off: rows that take off less are left to a smaller tool.
constexpr double min_share = 0.5;
/// Ways from pass to pass that are gone at this height (radii).
constexpr double linked_radii = 12;
/// How often half a width is laid before a place that would take off too much.
constexpr int max_tries = 3;
/// Of what may be taken off: by ramps; less where they turn in a narrow place.
constexpr std::array ramp_shares{0.9, 0.65, 0.45};
/// How far a row may give way to take off as much as it may (steps, of which so many are a width of cut), and of what
/// may be taken off: where less stands beside it, it goes on straight.
constexpr int steps_a_width = 10, max_steps_in = 6, max_steps_out = 6;
constexpr double beside_share = 0.1;

}  // namespace

Clearing::Clearing(const ClearingTask& task, RowLayout layout, StockTop& surface)
    : task_(task),
      surface_(surface),
      lattice_(surface.lattice()),
      cap_m2_(cap_share * task.tool.max_depth_m * task.tool.max_width_m),
      width_m_(row_share * task.tool.max_width_m),
      load_(no_load()) {
  const Cutter& cutter = task.tool.cutter;
  double cleared = 0;
  while (cleared < cutter.radius_m - task.seam_m && cutter.height_m(cleared) <= task.cusp_m)
    cleared += lattice_.step / 4;
  const double step = std::max(step_share * cutter.radius_m, 2 * lattice_.step);
  const double inside = std::min(cleared, first_row_inside(task.tool, lattice_.step)) - lattice_.step;
  rows_.emplace(LevelArea{lattice_, task.is_free, task.stands, cutter.radius_m, width_m_, cleared, inside, step},
                layout);
  for (const LevelRow& row : rows_->rows()) {
    Turn turn{row};
    for (std::size_t other = 0; other < turns_.size(); ++other)
      if (turns_[other].row.rank > row.rank && are_near(row, turns_[other].row, cutter.radius_m + width_m_))
        turn.after.push_back(other);
    turns_.push_back(std::move(turn));
  }
}

double Clearing::volume(const Point2& from, const Point2& to) const {
  return surface_.volume(at_level(from), at_level(to));
}

ChipLoad Clearing::no_load() const {
  const double radius = task_.tool.cutter.radius_m;
  return ChipLoad({cap_m2_, cap_m2_ * radius / bits_a_radius + burst_share * cap_m2_ * 2 * radius, 2 * radius,
                   window_share / cap_share * cap_m2_});
}

/// Where a pass begins: that of the last one, if the tip is there still.
ChipLoad Clearing::load_at(const Point2& begin, const std::optional<Point2>& tip) const {
  return tip && begin == *tip ? load_ : no_load();
}

/// Bit by bit: what a long edge takes off at its end does not count by all of it. `before_m3` of it is gone already.
bool Clearing::bears(ChipLoad& load, const Vec3& from, const Vec3& to, double before_m3) const {
  const double length = (to - from).norm();
  const int bits = std::max(1, static_cast<int>(std::ceil(length * bits_a_radius / task_.tool.cutter.radius_m)));
  for (int bit = 1; bit <= bits; ++bit) {
    const double so_far_m3 = surface_.volume(from, from + (to - from) * bit / bits);
    if (!load.bears(std::max(0.0, so_far_m3 - before_m3), length / bits)) return false;
    before_m3 = so_far_m3;
  }
  return true;
}

/// Nowhere more than it may?
bool Clearing::may_cut(const LevelWay& way, ChipLoad load) const {
  for (std::size_t edge = 0; edge + 1 < way.size(); ++edge) {
    const Point2 &from = way[edge], &to = way[edge + 1];
    if (!edge_is_free(from, to) || !bears(load, at_level(from), at_level(to), edge == 0 ? 0 : volume(from, from)))
      return false;
  }
  return true;
}

/// The cutter takes off little there, or nothing.
bool Clearing::is_open(const Point2& p) const {
  return edge_is_free(p, p) && volume(p, p) <= little_share * cap_m2_ * task_.tool.cutter.radius_m;
}

bool Clearing::is_worth_it(const LevelRow& row) const {
  const double enough_m3 = min_share * cap_m2_ * length_of(row.points);
  double sum_m3 = 0;
  for (std::size_t at = 0; at + 1 < row.points.size() && sum_m3 < enough_m3; ++at) {
    const Point2 &from = row.points[at], &to = row.points[at + 1];
    sum_m3 += std::min(cap_m2_ * (to - from).norm(), volume(from, to));
  }
  return enough_m3 > 0 && sum_m3 >= enough_m3;
}

/// Of those whose turn it is.
std::optional<std::size_t> Clearing::nearest(const Point2& at) const {
  std::optional<std::size_t> nearest;
  double least = 0;
  for (std::size_t number = 0; number < turns_.size(); ++number) {
    const Turn& turn = turns_[number];
    if (turn.is_done || std::ranges::any_of(turn.after, [&](std::size_t before) { return !turns_[before].is_done; }))
      continue;
    const auto look = [&](const Point2& p) {
      const double far = (p - at).squaredNorm();
      if (nearest && far >= least) return;
      nearest = number;
      least = far;
    };
    if (turn.row.is_closed) {
      std::ranges::for_each(turn.row.points, look);
    } else {
      look(turn.row.points.front());
      look(turn.row.points.back());
    }
  }
  return nearest;
}

/// From where the tip is, if that is near; or from where it is open, the shortest with the way to there.
LevelWay Clearing::enter(const LevelRow& row, const std::optional<Point2>& tip) const {
  const Point2& begin = row.points.front();
  if (tip && (begin - *tip).norm() <= linked_radii * task_.tool.cutter.radius_m && may_cut({*tip, begin}, load_))
    return {*tip, begin};
  LevelWay best;
  double least_m = 0;
  for (LevelWay& way : ways_into(row, task_.tool.cutter.radius_m, width_m_)) {
    if (!is_open(way.front()) || !may_cut(way, load_at(way.front(), tip))) continue;
    const auto over_m = task_.way_over_m(at_level(way.front()));
    if (!over_m) continue;
    const double all_m = *over_m + length_of(way);
    if (!best.empty() && all_m >= least_m) continue;
    best = std::move(way);
    least_m = all_m;
  }
  return best;
}

/// The highest place that the cutter takes off along it.
double Clearing::top_along(const LevelRow& row) const {
  double top = task_.height;
  for (std::size_t at = 0; at + 1 < row.points.size(); ++at)
    top = std::max(top, surface_.highest(at_level(row.points[at]), at_level(row.points[at + 1])).value_or(top));
  return top;
}

/// Where nothing is open: from the top of what stands down along it, as deep each time as a slot may be.
LevelPass Clearing::enter_by_ramp(const LevelRow& row) {
  const double top = top_along(row), slot_m = cap_m2_ / (2 * task_.tool.cutter.radius_m);
  for (const double share : ramp_shares) {
    LevelPass pass = ramp_along(row.points, row.is_closed, top, task_.height, share * slot_m);
    if (pass.empty() || !task_.way_over_m(pass.front())) return {};
    if (go_down(pass)) return pass;
  }
  return {};
}

/// All of it, or nothing where it takes off too much.
bool Clearing::go_down(const LevelPass& pass) {
  const StockTop before = surface_;
  const double taken_before = taken_m3_;
  ChipLoad load = no_load();
  for (std::size_t at = 0; at + 1 < pass.size(); ++at) {
    const Vec3 &from = pass[at], &to = pass[at + 1];
    if (edge_is_free(from.head<2>(), to.head<2>()) && bears(load, from, to, 0)) {
      taken_m3_ += surface_.cut(from, to);
      continue;
    }
    surface_ = before;
    taken_m3_ = taken_before;
    return false;
  }
  load_ = std::move(load);
  return true;
}

/// What would take off too much comes once more, after a row that is farther out.
void Clearing::put_off(std::size_t number, std::size_t refused) {
  const LevelRow row = turns_[number].row;
  const int tries = turns_[number].tries;
  // Of an edge what the one before it leaves.
  const auto is_too_much = [&](const Point2& from, const Point2& to) {
    return volume(from, to) - volume(from, from) > cap_m2_ * (to - from).norm();
  };
  std::size_t end = refused + 1;
  while (end + 1 < row.points.size() && is_too_much(row.points[end], row.points[end + 1])) ++end;
  Turn rest{{row.field, {row.points.begin() + static_cast<std::ptrdiff_t>(refused), row.points.end()}}};
  if (tries < max_tries) {
    Turn outer{{row.field, {}}};
    outer.tries = rest.tries = tries + 1;
    for (std::size_t at = refused > 0 ? refused - 1 : 0; at <= std::min(end + 1, row.points.size() - 1); ++at)
      outer.row.points.push_back(row.points[at] + width_m_ / 2 * row.field->outwards(row.points[at]));
    rest.after.push_back(turns_.size());
    turns_.push_back(std::move(outer));
  } else {
    rest.row.points.erase(rest.row.points.begin(),
                          rest.row.points.begin() + static_cast<std::ptrdiff_t>(end - refused));
  }
  if (rest.row.points.size() > 1) turns_.push_back(std::move(rest));
}

/// The place abreast of `to` where the cutter takes off as much as it may: as far inside or as little farther out
/// (constant engagement: Stori, Wright, "Constant engagement tool path generation for convex geometries", 2000).
/// Nothing where it takes off too much everywhere.
std::optional<Point2> Clearing::keep_engagement(const Point2& from, const Point2& to, const RowField& field,
                                                ChipLoad& load) const {
  const Point2 out = width_m_ / steps_a_width * field.outwards(to);
  // Of the whole edge first, for that is soon asked.
  const auto may_be = [&](int steps_out) {
    const Point2 place = to + steps_out * out;
    return edge_is_free(from, place) &&
           volume(from, place) <= cap_m2_ * ((place - from).norm() + burst_share * task_.tool.cutter.radius_m);
  };
  int first = 0;
  if (volume(from, to) >= beside_share * cap_m2_ * (to - from).norm())
    while (first > -max_steps_in && may_be(first - 1)) --first;
  for (int steps = first; steps <= max_steps_out; ++steps) {
    const Point2 place = to + steps * out;
    ChipLoad after = load;
    if (!edge_is_free(from, place) || !bears(after, at_level(from), at_level(place), 0)) continue;
    if (steps < 0 && after.used() > used_inside) continue;
    load = std::move(after);
    return place;
  }
  return std::nullopt;
}

/// As far as it takes off no more than it may.
LevelPass Clearing::follow(std::size_t number, const std::optional<Point2>& tip) {
  turns_[number].is_done = true;
  LevelRow& row_now = turns_[number].row;
  LevelWay way = enter(row_now, tip);
  if (way.empty() && !row_now.is_closed) {
    std::ranges::reverse(row_now.points);
    way = enter(row_now, tip);
  }
  if (way.empty()) return enter_by_ramp(row_now);
  const LevelRow row = row_now;  // turns are added below
  LevelPass pass{at_level(way.front())};
  const auto go = [&](const Point2& to) {
    taken_m3_ += surface_.cut(pass.back(), at_level(to));
    pass.push_back(at_level(to));
  };
  load_ = load_at(way.front(), tip);
  for (std::size_t at = 1; at < way.size(); ++at) {
    bears(load_, pass.back(), at_level(way[at]), at == 1 ? volume(way[0], way[0]) : 0);
    go(way[at]);
  }
  for (std::size_t at = 0; at + 1 < row.points.size(); ++at) {
    const Point2 from = pass.back().head<2>(), &to = row.points[at + 1];
    if (!edge_is_free(from, to)) {
      if (at + 2 < row.points.size())
        turns_.push_back({{row.field, {row.points.begin() + static_cast<std::ptrdiff_t>(at) + 1, row.points.end()}}});
      break;
    }
    const auto place = keep_engagement(from, to, *row.field, load_);
    if (!place) {
      put_off(number, at);
      break;
    }
    go(*place);
  }
  return pass;
}

std::optional<LevelPass> Clearing::next_from(const Point2& at, bool is_down) {
  while (const auto number = nearest(at)) {
    Turn& turn = turns_[*number];
    if (!is_worth_it(turn.row)) {
      turn.is_done = true;
      continue;
    }
    turn_towards(turn.row, at);
    LevelPass pass = follow(*number, is_down ? std::optional(at) : std::nullopt);
    if (pass.size() > 1) return pass;
  }
  return std::nullopt;
}

}  // namespace sculpt
