#include "core/mill/rough/clearing.hpp"

#include <algorithm>
#include <cmath>

#include "core/mill/rough/ramp.hpp"

namespace sculpt {
namespace {

/// Of the cutter's radius: how long an edge is.
constexpr double step_share = 0.8;
/// Of depth times width of cut: what may be taken off.
constexpr double cap_share = 1.08;
/// Of what may be taken off over a radius, where a pass begins.
constexpr double little_share = 0.05;
/// Of what may be taken off: rows that take off less are left to a smaller tool.
constexpr double min_share = 0.15;
/// Ways from pass to pass that are gone at this height (radii).
constexpr double linked_radii = 12;
/// How often half a width is laid before a place that would take off too much.
constexpr int max_tries = 3;
/// Of what may be taken off: by ramps.
constexpr double ramp_share = 0.9;

/// How far inside the edge of a slab, as thick as the depth of cut, the tip takes off depth times width; negative: so
/// far outside. To `step_m`, and no more.
double first_row_inside(const MillTool& tool, double step_m) {
  const double radius = tool.cutter.radius_m;
  double off = -radius, section_m2 = 0;
  while (off + step_m < radius) {
    section_m2 += step_m * std::max(0.0, tool.max_depth_m - tool.cutter.height_m(std::abs(off + step_m / 2)));
    if (section_m2 > tool.max_depth_m * tool.max_width_m) break;
    off += step_m;
  }
  return off;
}

}  // namespace

Clearing::Clearing(const ClearingTask& task, RowLayout layout, StockTop& surface)
    : task_(task),
      surface_(surface),
      lattice_(surface.lattice()),
      cap_m2_(cap_share * task.tool.max_depth_m * task.tool.max_width_m),
      width_m_(task.tool.max_width_m) {
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
      if (turns_[other].row.rank > row.rank && are_near(row, turns_[other].row)) turn.after.push_back(other);
    turns_.push_back(std::move(turn));
  }
}

void Clearing::cut(const Vec3& from, const Vec3& to) {
  double heights = 0;
  surface_.cut(from, to, [&](std::size_t at, float before) {
    heights += static_cast<double>(before - surface_.map().heights[at]);
  });
  taken_m3_ += heights * lattice_.step * lattice_.step;
}

double Clearing::volume(const Point2& from, const Point2& to) const {
  return surface_.volume(at_level(from), at_level(to));
}

/// Nowhere more than it may, bit by bit: what a long edge takes off at its end does not count by all of its length.
bool Clearing::may_cut(const Way& way) const {
  ChipWindow window = chip_window();
  bool is_first = true;
  for (std::size_t edge = 0; edge + 1 < way.size(); ++edge) {
    const Point2 &from = way[edge], &to = way[edge + 1];
    if (!edge_is_free(from, to)) return false;
    const double length = (to - from).norm();
    const int bits = std::max(1, static_cast<int>(std::ceil(length / window.length_m())));
    for (int bit = 0; bit < bits; ++bit) {
      const Point2 p = from + (to - from) * bit / bits, q = from + (to - from) * (bit + 1) / bits;
      // The bit before it has been where it begins.
      if (!window.take(volume(p, q) - (is_first ? 0 : volume(p, p)), length / bits)) return false;
      is_first = false;
    }
  }
  return true;
}

/// The cutter takes off little there, or nothing.
bool Clearing::is_open(const Point2& p) const {
  return edge_is_free(p, p) && volume(p, p) <= little_share * cap_m2_ * task_.tool.cutter.radius_m;
}

bool Clearing::are_near(const LevelRow& one, const LevelRow& other) const {
  const double near2 = std::pow(task_.tool.cutter.radius_m + width_m_, 2);
  return std::ranges::any_of(one.points, [&](const Point2& p) {
    return std::ranges::any_of(other.points, [&](const Point2& q) { return (p - q).squaredNorm() < near2; });
  });
}

bool Clearing::is_worth_it(const LevelRow& row) const {
  double sum = 0, all = 0;
  for (std::size_t at = 0; at + 1 < row.points.size(); ++at) {
    const Point2 &from = row.points[at], &to = row.points[at + 1];
    const double most = cap_m2_ * (to - from).norm();
    sum += std::min(most, volume(from, to));
    all += most;
  }
  return all > 0 && sum >= min_share * all;
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

void Clearing::turn_towards(LevelRow& row, const Point2& at) const {
  const auto far = [&](const Point2& p) { return (p - at).squaredNorm(); };
  if (row.is_closed) {
    row.points.pop_back();
    std::rotate(row.points.begin(), std::ranges::min_element(row.points, {}, far), row.points.end());
    row.points.push_back(row.points.front());
  } else if (far(row.points.back()) < far(row.points.front())) {
    std::ranges::reverse(row.points);
  }
}

/// Straight, from farther outside or from before its beginning; into a ring bit by bit.
std::vector<Clearing::Way> Clearing::ways_into(const LevelRow& row) const {
  const Point2 begin = row.points.front(), out = row.field->outwards(begin),
               ahead = (row.points[1] - begin).normalized();
  const double radius = task_.tool.cutter.radius_m;
  std::vector<Way> ways{{begin}};
  for (int halves = 1; halves <= 6; ++halves) ways.push_back({begin + halves * width_m_ / 2 * out, begin});
  for (const double radii : {1.0, 2.0}) ways.push_back({begin - radii * radius * ahead, begin});
  for (const double radii : {3.0, 6.0}) {
    if (!row.is_closed) break;
    Way way{begin};
    double back = 0;
    for (std::size_t at = row.points.size() - 1; at > 0 && back < radii * radius; --at) {
      back += (row.points[at] - row.points[at - 1]).norm();
      const Point2& p = row.points[at - 1];
      way.push_back(p + std::min(1.0, back / (radii * radius)) * width_m_ * row.field->outwards(p));
    }
    std::ranges::reverse(way);
    ways.push_back(std::move(way));
  }
  return ways;
}

/// From where the tip is, if that is near; or from where it is open.
Clearing::Way Clearing::enter(const LevelRow& row, const std::optional<Point2>& tip) const {
  const Point2& begin = row.points.front();
  if (tip && (begin - *tip).norm() <= linked_radii * task_.tool.cutter.radius_m && may_cut({*tip, begin}))
    return {*tip, begin};
  for (Way& way : ways_into(row))
    if (is_open(way.front()) && may_cut(way) && task_.comes_down(at_level(way.front()))) return std::move(way);
  return {};
}

/// The highest place that the cutter meets along it.
double Clearing::top_along(const LevelRow& row) const {
  float top = static_cast<float>(task_.height);
  for (std::size_t at = 0; at + 1 < row.points.size(); ++at)
    for_each_cell_near(lattice_, at_level(row.points[at]), at_level(row.points[at + 1]), task_.tool.cutter.radius_m,
                       [&](int a, int b) { top = std::max(top, surface_.map().at(a, b)); });
  return static_cast<double>(top);
}

/// Where nothing is open: from the top of what stands down along it, as deep each time as a slot may be.
LevelPass Clearing::enter_by_ramp(const LevelRow& row) {
  const double slot_m = ramp_share * cap_m2_ / (2 * task_.tool.cutter.radius_m);
  LevelPass pass = ramp_along(row.points, row.is_closed, top_along(row), task_.height, slot_m);
  if (pass.empty() || !task_.comes_down(pass.front())) return {};
  const StockTop before = surface_;
  const double taken_before = taken_m3_;
  ChipWindow window = chip_window();
  for (std::size_t at = 0; at + 1 < pass.size(); ++at) {
    const Vec3 &from = pass[at], &to = pass[at + 1];
    if (edge_is_free(from.head<2>(), to.head<2>()) && window.take(surface_.volume(from, to), (to - from).norm())) {
      cut(from, to);
      continue;
    }
    surface_ = before;
    taken_m3_ = taken_before;
    return {};
  }
  return pass;
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

/// As far as it takes off no more than it may.
LevelPass Clearing::follow(std::size_t number, const std::optional<Point2>& tip) {
  turns_[number].is_done = true;
  LevelRow& row_now = turns_[number].row;
  Way way = enter(row_now, tip);
  if (way.empty() && !row_now.is_closed) {
    std::ranges::reverse(row_now.points);
    way = enter(row_now, tip);
  }
  if (way.empty()) return enter_by_ramp(row_now);
  const LevelRow row = row_now;  // turns are added below
  LevelPass pass{at_level(way.front())};
  const auto go = [&](const Point2& to) {
    cut(pass.back(), at_level(to));
    pass.push_back(at_level(to));
  };
  std::for_each(way.begin() + 1, way.end(), go);
  ChipWindow window = chip_window();
  for (std::size_t at = 0; at + 1 < row.points.size(); ++at) {
    const Point2 &from = row.points[at], &to = row.points[at + 1];
    if (!edge_is_free(from, to)) {
      if (at + 2 < row.points.size())
        turns_.push_back({{row.field, {row.points.begin() + static_cast<std::ptrdiff_t>(at) + 1, row.points.end()}}});
      break;
    }
    if (!window.take(volume(from, to), (to - from).norm())) {
      put_off(number, at);
      break;
    }
    go(to);
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
