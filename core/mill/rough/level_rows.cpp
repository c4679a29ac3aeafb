#include "core/mill/rough/level_rows.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/mill/map/cell_box.hpp"
#include "core/mill/rough/cell_distances.hpp"

namespace sculpt {
namespace {

/// The last row is so far from where the tip may not be (cells), the one before it so much nearer than others are.
constexpr double last_row_cells = 1.2, last_share = 0.7;
/// Where that leaves it no room: so far, and no place with room is so near (cells).
constexpr double narrow_row_cells = 0.9;
constexpr int narrow_cells = 2;
/// Of the width of cut: from one curve around to the next, for in hollow corners each finds more than the distance
/// before it; and what straight rows leave for the last one around.
constexpr double around_share = 0.92, ring_share = 0.9;
/// Gaps in a row that are gone through (radii).
constexpr double bridged_radii = 3;
/// How far edges leave out the corners of a curve (cells).
constexpr double straight_cells = 0.4;

/// Of all marked cells.
CellBox box_of(const std::vector<char>& marked, const Lattice& lattice) {
  CellBox box{lattice.width, -1, lattice.height, -1};
  for (int b = 0; b < lattice.height; ++b)
    for (int a = 0; a < lattice.width; ++a)
      if (marked[lattice.index(a, b)])
        box = {std::min(box.first_a, a), std::max(box.last_a, a), std::min(box.first_b, b), b};
  return box;
}

/// The distance across the rows from a place (m, of the lattice), and `more`; on one side of it the distance is
/// negative if `is_signed`.
RowField straight_field(const Lattice& lattice, RowLayout layout, double place, bool is_signed, double more) {
  RowField field{lattice, {}};
  field.values.reserve(lattice.size());
  for (int b = 0; b < lattice.height; ++b)
    for (int a = 0; a < lattice.width; ++a) {
      const double across = (layout == RowLayout::along_u ? lattice.v(b) : lattice.u(a)) - place;
      field.values.push_back(static_cast<float>((is_signed ? across : std::abs(across)) + more));
    }
  return field;
}

/// Where straight rows are counted from (m): the edge of what is marked, or its middle.
double place_of(const CellBox& marked, const Lattice& all, RowLayout layout, bool middle) {
  const bool is_u = layout == RowLayout::along_u;
  const double first = is_u ? all.v(marked.first_b) : all.u(marked.first_a),
               last = is_u ? all.v(marked.last_b) : all.u(marked.last_a);
  return middle ? (first + last) / 2 : first - all.step / 2;
}

/// The largest value at cells that are marked; the field is over a box of their lattice.
double farthest_of(const RowField& field, const std::vector<char>& marked, const Lattice& all, const CellBox& box) {
  double farthest = 0;
  for (int b = 0; b < field.lattice.height; ++b)
    for (int a = 0; a < field.lattice.width; ++a)
      if (marked[all.index(a + box.first_a, b + box.first_b)])
        farthest = std::max(farthest, static_cast<double>(field.values[field.lattice.index(a, b)]));
  return farthest;
}

}  // namespace

bool edge_is_free(const Lattice& lattice, const std::vector<char>& is_free, const Point2& from, const Point2& to) {
  bool free = lattice.contains(lattice.cell_u(to.x()), lattice.cell_v(to.y()));
  for_each_cell_near(lattice, {from.x(), from.y(), 0}, {to.x(), to.y(), 0}, 0,
                     [&](int a, int b) { free = free && is_free[lattice.index(a, b)]; });
  return free;
}

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

LevelRows::LevelRows(const LevelArea& task, RowLayout layout) : task_(task), stands_(task.stands) {
  const Lattice& all = task_.lattice;
  const CellBox marked = box_of(task_.stands, all);
  if (marked.last_a < marked.first_a) return;
  const CellBox near = marked.grown(static_cast<int>(task_.radius_m / all.step), all),
                box = near.grown(static_cast<int>(task_.width_m / all.step) + 2, all);
  const Lattice lattice = box.of(all);
  // Where the tip may not be, about what is to come off.
  std::vector<char> shut(lattice.size());
  for (int b = near.first_b; b <= near.last_b; ++b)
    for (int a = near.first_a; a <= near.last_a; ++a)
      shut[lattice.index(a - box.first_a, b - box.first_b)] = task_.is_free[all.index(a, b)] ? 0 : 1;
  const bool is_around = layout == RowLayout::around, any = std::ranges::count(shut, 1) > 0;
  if (is_around && !any) return;
  const double last = last_row_cells * lattice.step;
  if (any) fields_.push_back(std::make_unique<RowField>(RowField{lattice, distances_to(shut, lattice)}));
  if (!is_around)
    fields_.push_back(std::make_unique<RowField>(
        straight_field(lattice, layout, place_of(marked, all, layout, any), !any, last - task_.cleared_m)));
  const double farthest = farthest_of(*fields_.back(), task_.stands, all, box);
  if (is_around)
    lay_around(farthest);
  else
    lay_straight(farthest, any);
}

/// From the outside inwards: level curves about where the tip may not be, the last one nearer, and what is left.
void LevelRows::lay_around(double farthest) {
  const RowField& field = *fields_.front();
  const double last = last_row_cells * task_.lattice.step, width = around_share * task_.width_m,
               first = last + (last_share - 1) * width, cleared = task_.cleared_m, outside = width - cleared;
  const int count = static_cast<int>(std::ceil((farthest + cleared - first) / width));
  for (int number = count; number > 0; --number) lay(field, 2 * number, first + number * width, cleared, outside);
  lay_ring(outside);
  // Along ridges of the field, between two rows of which the outer one does not come there.
  for (const LevelRow& row : rows_) clear_beside(row);
  for (int number = count; number > 0; --number)
    lay(field, 2 * number - 1, first + (number - 0.5) * width, cleared, cleared);
}

/// All as far apart, from one side to the other; where the tip may not be somewhere (`any`) from both to the middle and
/// one around that, for which they leave something.
void LevelRows::lay_straight(double farthest, bool any) {
  const RowField& field = *fields_.back();
  const double last = last_row_cells * task_.lattice.step, all = farthest - task_.inside_m - last;
  const double cleared = task_.cleared_m, outside = task_.width_m - cleared;
  const int count = std::max(0, static_cast<int>(std::ceil(all / task_.width_m)));
  if (any) leave_for_ring();
  for (int number = count; number > 0; --number) lay(field, number, last + number * all / count, cleared, outside);
  lay(field, 0, last, task_.radius_m, outside);
  stands_ = task_.stands;
  if (any) lay_ring(cleared);
}

/// Around where the tip may not be, the last one; once more through passages that it has no room in.
void LevelRows::lay_ring(double outside) {
  const RowField& to_shut = *fields_.front();
  const double step = task_.lattice.step;
  lay(to_shut, -1, last_row_cells * step, task_.radius_m, outside);
  lay(to_shut, -1, narrow_row_cells * step,
      [&](const Point2& p) { return is_narrow(p) && is_needed(to_shut, p, task_.radius_m, outside); });
}

bool LevelRows::is_narrow(const Point2& p) const {
  const RowField& to_shut = *fields_.front();
  bool narrow = true;
  for_each_cell_near(to_shut.lattice, {p.x(), p.y(), 0}, {p.x(), p.y(), 0}, narrow_cells * to_shut.lattice.step,
                     [&](int a, int b) {
                       const auto far = static_cast<double>(to_shut.values[to_shut.lattice.index(a, b)]);
                       narrow = narrow && far < last_row_cells * to_shut.lattice.step;
                     });
  return narrow;
}

/// Rows need not come so near to where the tip may not be: the ring around it would have nothing to take off.
void LevelRows::leave_for_ring() {
  const RowField& to_shut = *fields_.front();
  const Lattice& box = to_shut.lattice;
  for (int b = 0; b < box.height; ++b)
    for (int a = 0; a < box.width; ++a)
      if (static_cast<double>(to_shut.values[box.index(a, b)]) <= ring_share * task_.width_m)
        stands_[task_.lattice.index(task_.lattice.cell_u(box.u(a)), task_.lattice.cell_v(box.v(b)))] = 0;
}

void LevelRows::clear_beside(const LevelRow& row) {
  for (std::size_t at = 0; at + 1 < row.points.size(); ++at) {
    const Point2 &from = row.points[at], &to = row.points[at + 1];
    for_each_cell_near(task_.lattice, {from.x(), from.y(), 0}, {to.x(), to.y(), 0}, task_.cleared_m,
                       [&](int a, int b) { stands_[task_.lattice.index(a, b)] = 0; });
  }
}

/// Does anything stand beside it, so far on both sides?
bool LevelRows::is_needed(const RowField& field, const Point2& p, double inside, double outside) const {
  const Lattice& lattice = task_.lattice;
  const auto cell = [&](const Point2& at) -> std::optional<std::size_t> {
    const int a = lattice.cell_u(at.x()), b = lattice.cell_v(at.y());
    return lattice.contains(a, b) ? std::optional(lattice.index(a, b)) : std::nullopt;
  };
  const auto here = cell(p);
  if (!here || !task_.is_free[*here]) return false;
  const Point2 out = field.outwards(p);
  for (double off = -inside; off <= outside; off += lattice.step / 2)
    if (const auto beside = cell(p + off * out); beside && stands_[*beside]) return true;
  return false;
}

void LevelRows::lay(const RowField& field, int rank, double value, double inside, double outside) {
  lay(field, rank, value, [&](const Point2& p) { return is_needed(field, p, inside, outside); });
}

void LevelRows::lay(const RowField& field, int rank, double value,
                    const std::function<bool(const Point2&)>& is_wanted) {
  for (const Curve& curve : level_curves(field.values, field.lattice, value)) {
    std::vector<char> needed;
    for (const Point2& p : curve) needed.push_back(is_wanted(p) ? 1 : 0);
    if ((curve.front() - curve.back()).norm() != 0) {
      add_stretches({&field, {}, false, rank}, curve, needed);
      continue;
    }
    Curve ring(curve.begin(), curve.end() - 1);
    needed.pop_back();
    if (turn_to_gap(ring, needed))
      add_stretches({&field, {}, false, rank}, ring, needed);
    else
      rows_.push_back({&field, straightened(curve), true, rank});
  }
}

/// A ring is begun where nothing is to come off, or where it does not go through; false if there is no such place.
bool LevelRows::turn_to_gap(Curve& ring, std::vector<char>& needed) const {
  for (std::size_t at = 0; at < ring.size(); ++at) {
    const Point2& before = at > 0 ? ring[at - 1] : ring.back();
    if (needed[at] && edge_is_free(before, ring[at])) continue;
    std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(at), ring.end());
    std::rotate(needed.begin(), needed.begin() + static_cast<std::ptrdiff_t>(at), needed.end());
    return true;
  }
  return false;
}

/// The last place of a stretch that begins at one where something is to come off.
std::size_t LevelRows::end_of_stretch(const Curve& curve, const std::vector<char>& needed, std::size_t begin) const {
  std::size_t last = begin;
  double gap = 0;
  for (std::size_t next = begin + 1; next < curve.size() && gap <= bridged_radii * task_.radius_m; ++next) {
    if (!edge_is_free(curve[next - 1], curve[next])) break;
    gap += (curve[next] - curve[next - 1]).norm();
    if (!needed[next]) continue;
    last = next;
    gap = 0;
  }
  return last;
}

/// Like `row`, along those parts of a curve where something is to come off.
void LevelRows::add_stretches(LevelRow row, const Curve& curve, const std::vector<char>& needed) {
  for (std::size_t at = 0; at < curve.size(); ++at) {
    if (!needed[at]) continue;
    std::size_t last = end_of_stretch(curve, needed, at);
    // A place more at both ends, for what stands between two.
    const std::size_t begin = at > 0 && edge_is_free(curve[at - 1], curve[at]) ? at - 1 : at;
    if (last + 1 < curve.size() && edge_is_free(curve[last], curve[last + 1])) ++last;
    if (last > begin) {
      row.points = straightened(
          {curve.begin() + static_cast<std::ptrdiff_t>(begin), curve.begin() + static_cast<std::ptrdiff_t>(last) + 1});
      rows_.push_back(row);
    }
    at = last;
  }
}

/// Fewer, longer edges.
Curve LevelRows::straightened(const Curve& curve) const {
  const double max_off = straight_cells * task_.lattice.step;
  Curve straight{curve.front()};
  for (std::size_t at = 0; at + 1 < curve.size();) {
    std::size_t next = at + 1;
    for (std::size_t to = at + 2; to < curve.size(); ++to) {
      const Point2 way = curve[to] - curve[at];
      const double length = way.norm();
      if (length > task_.step_m) break;
      const auto is_near = [&](const Point2& p) {
        const Point2 off = p - curve[at];
        return std::abs(way.x() * off.y() - way.y() * off.x()) <= max_off * length;
      };
      if (length > 0 && !std::all_of(curve.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                                     curve.begin() + static_cast<std::ptrdiff_t>(to), is_near))
        break;
      if (!edge_is_free(curve[at], curve[to])) break;
      next = to;
    }
    straight.push_back(curve[next]);
    at = next;
  }
  return straight;
}

}  // namespace sculpt
