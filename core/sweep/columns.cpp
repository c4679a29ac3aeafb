#include "core/sweep/columns.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace sculpt {
Columns::Columns(const ToolView& view, const VoxelSet& standing, const VoxelSet& keep, const ReachRows& reach,
                 std::vector<Run> given_up)
    : view_(view),
      reach_(reach),
      standing_(view, standing),
      keep_(view, keep),
      covered_(0, 0, 0),
      covered_from_(view.n),
      given_up_(std::move(given_up)) {}

std::uint64_t Columns::count_cuttable() const {
  std::uint64_t count = 0;
  CellRows open(view_.n, view_.n, 1);  // columns in which nothing stopped the tool yet
  for (int b = 0; b < view_.n; ++b) set_cells(open.row(b, 0), 0, view_.n - 1);
  for (int c = view_.n - 1; c >= 0; --c)
    for (int b = 0; b < view_.n; ++b) {
      const std::uint64_t *standing = standing_.row(b, c), *keep = keep_.row(b, c), *reach = reach_.row(b, c);
      std::uint64_t* columns = open.row(b, 0);
      for (int chunk = 0; chunk < open.chunks(); ++chunk) {
        const std::uint64_t here = standing[chunk] & columns[chunk];
        if (here == 0) continue;
        const std::uint64_t left = here & (keep[chunk] | ~reach[chunk]);
        columns[chunk] &= ~left;
        count += static_cast<std::uint64_t>(std::popcount(here ^ left));
      }
    }
  return count;
}

Voxel Columns::cell(Voxel voxel) const {
  const Voxel from_corner = voxel - view_.corner;
  const auto along = [&](Voxel unit) {
    return from_corner.i * unit.i + from_corner.j * unit.j + from_corner.k * unit.k;
  };
  return {along(view_.step[0]), along(view_.step[1]), along(view_.step[2])};
}

Columns::Run Columns::run_of(const Stroke& stroke) const {
  const Voxel first = cell(stroke.first), last = cell(stroke.last);
  return {std::min(first.i, last.i), std::max(first.i, last.i), first.j, first.k};
}

void Columns::restore(const Stroke& stroke, bool give_up) {
  if (stroke.count == 0) return;
  const Run run = run_of(stroke);
  set_cells(standing_.row(run.b, run.c), run.first, run.last);
  covered_from_ = std::max(covered_from_, run.c + 1);
  if (give_up) given_up_.push_back(run);
}

void Columns::try_again(const Run& run) {
  std::erase(given_up_, run);
}

/// What is cut in a layer uncovers cells below it, so those layers are covered anew after each.
void Columns::cover_down_to(int c) {
  if (covered_.chunks() == 0) covered_ = CellRows(view_.n, view_.n, view_.n + 1);
  for (int layer = covered_from_ - 1; layer >= c; --layer)
    for (int b = 0; b < view_.n; ++b) {
      const std::uint64_t *standing = standing_.row(b, layer), *above = covered_.row(b, layer + 1);
      std::uint64_t* covered = covered_.row(b, layer);
      for (int chunk = 0; chunk < covered_.chunks(); ++chunk) covered[chunk] = standing[chunk] | above[chunk];
    }
  covered_from_ = c;
}

std::vector<std::vector<Columns::Run>> Columns::find_runs(int c) const {
  std::vector<std::vector<Run>> rows(static_cast<std::size_t>(view_.n));
  std::vector<Run> given_up;
  std::copy_if(given_up_.begin(), given_up_.end(), std::back_inserter(given_up),
               [c](const Run& run) { return run.c == c; });
  std::vector<std::uint64_t> free(static_cast<std::size_t>(covered_.chunks()));
  for (int b = 0; b < view_.n; ++b) {
    const std::uint64_t *standing = standing_.row(b, c), *above = covered_.row(b, c + 1), *keep = keep_.row(b, c),
                        *reach = reach_.row(b, c);
    for (std::size_t chunk = 0; chunk < free.size(); ++chunk)
      free[chunk] = standing[chunk] & ~above[chunk] & ~keep[chunk] & reach[chunk];
    for (const Run& run : given_up)
      if (run.b == b) clear_cells(free.data(), run.first, run.last);
    auto& row = rows[static_cast<std::size_t>(b)];
    for (std::size_t chunk = 0; chunk < free.size(); ++chunk)
      for (std::uint64_t bits = free[chunk]; bits != 0;) {
        const int skip = std::countr_zero(bits), length = std::countr_one(bits >> skip);
        const int first = 64 * static_cast<int>(chunk) + skip, last = first + length - 1;
        if (skip == 0 && !row.empty() && row.back().last == first - 1)
          row.back().last = last;
        else
          row.push_back({first, last, b, c});
        bits = skip + length == 64 ? 0 : bits >> (skip + length) << (skip + length);
      }
  }
  return rows;
}

std::vector<Stroke> Columns::cut_layer(int c, Vec3& at, double tolerance) {
  std::vector<Stroke> strokes;
  cover_down_to(c);
  auto rows = find_runs(c);
  std::size_t left = 0;
  for (const auto& row : rows) left += row.size();
  while (left > 0) {
    // The end of a run that is nearest, rows farther off counting double so that neighbouring rows come first.
    int best_row = 0;
    std::size_t best_run = 0;
    bool from_first = true;
    double least = std::numeric_limits<double>::max();
    for (int away = 0; away < view_.n && 2.0 * away < least; ++away) {
      for (int b : {static_cast<int>(std::lround(at.y())) + away, static_cast<int>(std::lround(at.y())) - away}) {
        if (b < 0 || b >= view_.n) continue;
        const auto& row = rows[static_cast<std::size_t>(b)];
        for (std::size_t run = 0; run < row.size(); ++run)
          for (bool first : {true, false}) {
            const double cost = 2.0 * away + std::abs((first ? row[run].first : row[run].last) - at.x());
            if (cost >= least) continue;
            least = cost;
            best_row = b;
            best_run = run;
            from_first = first;
          }
      }
    }
    auto& row = rows[static_cast<std::size_t>(best_row)];
    const Run run = row[best_run];
    row.erase(row.begin() + static_cast<std::ptrdiff_t>(best_run));
    --left;
    const Voxel first{from_first ? run.first : run.last, best_row, c},
        last{from_first ? run.last : run.first, best_row, c};
    go_to(first, at, tolerance, strokes);
    if (first != last) cut(first + Voxel{sign(last.i - first.i), 0, 0}, last, at, tolerance, strokes);
  }
  return strokes;
}

/// Along a row, straight from a neighbour of `first`.
void Columns::cut(Voxel first, Voxel last, Vec3& at, double tolerance, std::vector<Stroke>& strokes) {
  for (CellRows* rows : {&standing_, &covered_})
    clear_cells(rows->row(first.j, first.k), std::min(first.i, last.i), std::max(first.i, last.i));
  strokes.push_back({centre(last), l1(first, last) + 1, tolerance, view_.voxel(first), view_.voxel(last)});
  at = centre(last);
}

bool Columns::in_layer_free(int a0, int b0, int a1, int b1, int c) const {
  const int first = std::min(a0, a1), last = std::max(a0, a1);
  for (int b = std::min(b0, b1); b <= std::max(b0, b1); ++b)
    if (any_cell(covered_.row(b, c), first, last) || !all_cells(reach_.row(b, c), first, last)) return false;
  return true;
}

/// The lowest layer from `c` up where nothing stands, there or above, in any column that comes closer than a voxel to
/// the line.
int Columns::free_layer_between(const Vec3& from, const Vec3& to, int c) const {
  constexpr int beside = 2;
  const int steps = 1 + 2 * static_cast<int>((to - from).head<2>().norm()), end = view_.n - 1;
  const int first_b = std::max(0, static_cast<int>(std::lround(std::min(from.y(), to.y()))) - beside);
  const int last_b = std::min(end, static_cast<int>(std::lround(std::max(from.y(), to.y()))) + beside);
  std::vector<std::pair<int, int>> rows(static_cast<std::size_t>(last_b - first_b + 1), {end, 0});  // first and last a
  for (int s = 0; s <= steps; ++s) {
    const Vec3 here = from + (to - from) * (static_cast<double>(s) / steps);
    const int a = static_cast<int>(std::lround(here.x())), b = static_cast<int>(std::lround(here.y()));
    for (int bb = std::max(first_b, b - beside); bb <= std::min(last_b, b + beside); ++bb) {
      auto& [first, last] = rows[static_cast<std::size_t>(bb - first_b)];
      first = std::min(first, std::max(0, a - beside));
      last = std::max(last, std::min(end, a + beside));
    }
  }
  const auto is_free = [&](int layer) {
    for (int b = first_b; b <= last_b; ++b) {
      const auto& [first, last] = rows[static_cast<std::size_t>(b - first_b)];
      if (any_cell(covered_.row(b, layer), first, last)) return false;
    }
    return true;
  };
  int free = view_.n;
  while (c < free) {
    const int middle = (c + free) / 2;
    if (is_free(middle))
      free = middle;
    else
      c = middle + 1;
  }
  return free;
}

/// Brings the ball to `target` and cuts it: along its layer and in from beside, or along the layer where the ball is
/// and down, if there is a free way of two legs; else up and over.
void Columns::go_to(Voxel target, Vec3& at, double tolerance, std::vector<Stroke>& strokes) {
  const Voxel here{static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y())),
                   static_cast<int>(std::lround(at.z()))};
  const auto go = [&](const Vec3& to, double allowed) {
    if (to == at) return;
    strokes.push_back({to, 0, allowed, {}, {}});
    at = to;
  };
  const auto walk = [&](Voxel via, Voxel end) {
    if (!in_layer_free(here.i, here.j, via.i, via.j, here.k) || !in_layer_free(via.i, via.j, end.i, end.j, here.k))
      return false;
    go(centre(via), tolerance);
    go(centre(end), tolerance);
    return true;
  };
  const Voxel above = target + Voxel{0, 0, 1};
  bool there = false;
  if (here.k == target.k) {
    const Voxel beside_a = target - Voxel{sign(target.i - here.i), 0, 0},
                beside_b = target - Voxel{0, sign(target.j - here.j), 0};
    there = (target.j != here.j && walk({target.i, here.j, here.k}, beside_b)) ||
            (target.i != here.i && walk({here.i, target.j, here.k}, beside_a));
  } else if (here.k > target.k && here.k <= view_.n) {
    const Voxel over{target.i, target.j, here.k};
    there = walk({target.i, here.j, here.k}, over) || walk({here.i, target.j, here.k}, over);
    if (there) go(centre(above), tolerance);
  }
  if (!there) {
    const double high = std::max(free_layer_between(at, centre(above), target.k) + 1.0, at.z());
    go({at.x(), at.y(), high}, tolerance);
    go({static_cast<double>(above.i), static_cast<double>(above.j), high}, travel_tolerance);
    go(centre(above), tolerance);
  }
  cut(target, target, at, tolerance, strokes);
}

std::vector<Stroke> Columns::rise(Vec3& at, double tolerance) const {
  if (at.z() >= view_.n + 1) return {};
  at.z() = view_.n + 1;
  return {{at, 0, tolerance, {}, {}}};
}

}  // namespace sculpt
