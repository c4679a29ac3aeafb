#include "core/sweep/strokes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sculpt {
namespace {

/// Travelling above material keeps a voxel more than needed, so that long edges may bend by half a voxel.
constexpr double travel_stray = 0.5;

Vec3 centre(Voxel cell) {
  return {static_cast<double>(cell.i), static_cast<double>(cell.j), static_cast<double>(cell.k)};
}

int sign(int x) {
  return (x > 0) - (x < 0);
}

}  // namespace

Columns::Columns(const ToolView& view, const VoxelSet& standing, const VoxelSet& keep,
                 std::function<bool(const Vec3&)> reachable)
    : view_(view),
      corner_(static_cast<std::ptrdiff_t>(standing.index(view.corner))),
      standing_(standing),
      keep_(keep),
      reachable_(std::move(reachable)),
      heights_(static_cast<std::size_t>(view.n) * view.n),
      given_up_(view.n) {
  for (std::size_t along = 0; along < 3; ++along) {
    const Voxel step = view.step[along];
    stride_[along] = step.i + view.n * (step.j + static_cast<std::ptrdiff_t>(view.n) * step.k);
  }
  for (int b = 0; b < view.n; ++b)
    for (int a = 0; a < view.n; ++a) height(a, b) = top_below({a, b, view.n});
}

int Columns::top_below(Voxel cell) const {
  int c = cell.k;
  for (std::ptrdiff_t at = index(cell) - stride_[2]; c > 0 && !holds(standing_, at); at -= stride_[2]) --c;
  return c;
}

bool Columns::can_cut(Voxel cell) const {
  if (height(cell.i, cell.j) != cell.k + 1) return false;
  const std::ptrdiff_t at = index(cell);
  return !holds(keep_, at) && !holds(given_up_, at) && reachable_(centre(cell));
}

std::uint64_t Columns::count_cuttable() const {
  std::uint64_t count = 0;
  for (int b = 0; b < view_.n; ++b)
    for (int a = 0; a < view_.n; ++a) {
      std::ptrdiff_t at = index({a, b, height(a, b) - 1});
      for (int c = height(a, b) - 1; c >= 0; --c, at -= stride_[2]) {
        if (!holds(standing_, at)) continue;
        if (holds(keep_, at) || !reachable_(centre({a, b, c}))) break;
        ++count;
      }
    }
  return count;
}

void Columns::remove(Voxel cell) {
  standing_.erase(view_.voxel(cell));
  height(cell.i, cell.j) = top_below({cell.i, cell.j, height(cell.i, cell.j)});
}

void Columns::restore(const Stroke& stroke, bool give_up) {
  const Voxel way = stroke.last - stroke.first, step{sign(way.i), sign(way.j), sign(way.k)};
  const auto along = [](Voxel v, Voxel unit) { return v.i * unit.i + v.j * unit.j + v.k * unit.k; };
  for (int m = 0; m < stroke.count; ++m) {
    const Voxel voxel = stroke.first + step * m, from_corner = voxel - view_.corner;
    standing_.insert(voxel);
    if (give_up) given_up_.insert(voxel);
    int& h = height(along(from_corner, view_.step[0]), along(from_corner, view_.step[1]));
    h = std::max(h, along(from_corner, view_.step[2]) + 1);
  }
}

std::vector<std::vector<Columns::Run>> Columns::find_runs(int c) const {
  std::vector<std::vector<Run>> rows(static_cast<std::size_t>(view_.n));
  for (int b = 0; b < view_.n; ++b) {
    auto& row = rows[static_cast<std::size_t>(b)];
    bool open = false;
    for (int a = 0; a < view_.n; ++a) {
      const bool here = can_cut({a, b, c});
      if (here && open) row.back().last = a;
      if (here && !open) row.push_back({a, a});
      open = here;
    }
  }
  return rows;
}

std::vector<Stroke> Columns::cut_layer(int c, Vec3& at, double stray) {
  std::vector<Stroke> strokes;
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
    go_to(first, at, stray, strokes);
    if (first != last) cut(first + Voxel{sign(last.i - first.i), 0, 0}, last, at, stray, strokes);
  }
  return strokes;
}

/// Straight from a neighbour of `first`.
void Columns::cut(Voxel first, Voxel last, Vec3& at, double stray, std::vector<Stroke>& strokes) {
  Stroke stroke{centre(last), l1(first, last) + 1, stray, view_.voxel(first), view_.voxel(last)};
  const Voxel way = last - first, step{sign(way.i), sign(way.j), sign(way.k)};
  for (int m = 0; m < stroke.count; ++m) remove(first + step * m);
  strokes.push_back(stroke);
  at = stroke.to;
}

bool Columns::in_layer_free(int a0, int b0, int a1, int b1, int c) const {
  for (int b = std::min(b0, b1); b <= std::max(b0, b1); ++b)
    for (int a = std::min(a0, a1); a <= std::max(a0, a1); ++a)
      if (height(a, b) > c || !reachable_(centre({a, b, c}))) return false;
  return true;
}

/// Over all columns that come closer than a voxel to the line.
int Columns::highest_between(const Vec3& from, const Vec3& to) const {
  const int steps = 1 + 2 * static_cast<int>((to - from).head<2>().norm());
  int highest = 0;
  for (int s = 0; s <= steps; ++s) {
    const Vec3 here = from + (to - from) * (static_cast<double>(s) / steps);
    const int a = static_cast<int>(std::lround(here.x())), b = static_cast<int>(std::lround(here.y()));
    for (int bb = std::max(0, b - 2); bb <= std::min(view_.n - 1, b + 2); ++bb)
      for (int aa = std::max(0, a - 2); aa <= std::min(view_.n - 1, a + 2); ++aa)
        highest = std::max(highest, height(aa, bb));
  }
  return highest;
}

/// Brings the ball to `target` and cuts it: along its layer and in from beside, or along the layer where the ball is
/// and down, if there is a free way of two legs; else up and over.
void Columns::go_to(Voxel target, Vec3& at, double stray, std::vector<Stroke>& strokes) {
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
    go(centre(via), stray);
    go(centre(end), stray);
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
    if (there) go(centre(above), stray);
  }
  if (!there) {
    const double high = std::max({highest_between(at, centre(above)) + 1.0, at.z(), static_cast<double>(above.k)});
    go({at.x(), at.y(), high}, stray);
    go({static_cast<double>(above.i), static_cast<double>(above.j), high}, travel_stray);
    go(centre(above), stray);
  }
  cut(target, target, at, stray, strokes);
}

std::vector<Stroke> Columns::rise(Vec3& at, double stray) const {
  if (at.z() >= view_.n + 1) return {};
  at.z() = view_.n + 1;
  return {{at, 0, stray, {}, {}}};
}

}  // namespace sculpt
