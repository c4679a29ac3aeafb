#include "core/sweep/slanted_cuts.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace sculpt {
namespace {

/// Outside the grid the ball keeps a voxel more than needed, so that long edges may leave their line by half a voxel.
constexpr int outside_by = 2;  ///< cells from the last of the grid to where the ball travels
/// Of the search around the ball: cells looked at, and how far off they may be.
constexpr std::size_t max_hops = 3000;
/// After so many cells it goes on only if some cut is so few steps off: in open air it comes no farther than that.
constexpr std::size_t first_hops = 256;
constexpr int max_window_steps = 16;
constexpr int window = 64;  ///< a row of it is a word

int dot(Voxel a, Voxel b) {
  return a.i * b.i + a.j * b.j + a.k * b.k;
}

template <typename Visit>
void for_each_cut(const Stroke& stroke, const Visit& visit) {
  const Voxel step = sign(stroke.last - stroke.first);
  for (int m = 0; m < stroke.count; ++m) visit(stroke.first + step * m);
}

}  // namespace

SlantedCuts::SlantedCuts(const ToolView& view, const VoxelSet& standing, const std::vector<Voxel>& wanted, Voxel gate,
                         std::function<bool(const Vec3&)> reachable, std::function<bool(Voxel)> take)
    : view_(view),
      gate_(gate),
      reachable_(std::move(reachable)),
      take_(std::move(take)),
      shadow_(standing, view.along(view.lean)),
      wanted_(view.n),
      at_(gate),
      seen_(static_cast<std::size_t>(window) * window) {
  for (const Voxel v : wanted) {
    wanted_.insert(v);
    if (shadow_.is_clear(v)) lit_.push_back(view_.cell(v));
  }
}

/// The grid and the room beyond it, on the sides that the axis leans to.
bool SlantedCuts::is_in_bounds(Voxel cell) const {
  const auto in = [n = view_.n](int x, int lean) { return x >= 0 && x < n + outside_by * lean; };
  return in(cell.i, view_.lean.i) && in(cell.j, view_.lean.j) && in(cell.k, view_.lean.k);
}

bool SlantedCuts::is_reachable(Voxel cell) const {
  return reachable_(centre(cell));
}

SlantedCuts::Place SlantedCuts::look_at(Voxel cell) const {
  const Voxel voxel = view_.voxel(cell);
  const bool inside = Grid{view_.n, 1, Vec3::Zero()}.contains(voxel);
  if (inside ? !shadow_.is_clear(voxel) : !is_in_bounds(cell)) return Place::closed;
  const bool stands = inside && shadow_.standing().contains(voxel);
  if ((stands && !wanted_.contains(voxel)) || !is_reachable(cell)) return Place::closed;
  return stands ? Place::to_cut : Place::free;
}

/// Along the axis to where the ball travels.
Voxel SlantedCuts::way_out(Voxel cell) const {
  const int last = view_.n - 1 + outside_by;
  int far = std::numeric_limits<int>::max();
  if (view_.lean.i != 0) far = std::min(far, last - cell.i);
  if (view_.lean.j != 0) far = std::min(far, last - cell.j);
  if (view_.lean.k != 0) far = std::min(far, last - cell.k);
  return cell + view_.lean * far;
}

Sortie SlantedCuts::plan_sortie(std::size_t most) {
  Sortie sortie;
  at_ = gate_;
  last_step_ = {};
  while (sortie.cuts < most && ((at_ != gate_ && cut_near(sortie)) || cut_far(sortie))) {
  }
  if (sortie.cuts == 0) return sortie;
  const Voxel out = way_out(at_);
  if (const auto way = route(out, gate_)) {
    go(out, 0, sortie);
    for (const Voxel via : *way) go(via, travel_tolerance, sortie);
  } else {
    retrace(sortie);
  }
  sortie.serves.resize(sortie.strokes.size(), sortie.serves.back());
  return sortie;
}

/// The way that it came.
void SlantedCuts::retrace(Sortie& sortie) {
  for (std::size_t stroke = sortie.strokes.size(); stroke-- > 0;) {
    const Vec3 before = stroke == 0 ? centre(gate_) : sortie.strokes[stroke - 1].to;
    sortie.strokes.push_back({before, 0, sortie.strokes[stroke].tolerance, {}, {}});
  }
  at_ = gate_;
}

bool SlantedCuts::see(Voxel cell) {
  const Voxel at = cell - at_ + Voxel{window / 2, window / 2, window / 2};
  if (!Grid{window, 1, Vec3::Zero()}.contains(at)) return false;
  const auto row = static_cast<std::size_t>(at.k * window + at.j);
  const std::uint64_t bit = std::uint64_t{1} << at.i;
  if ((seen_[row] & bit) != 0) return false;
  if (seen_[row] == 0) seen_rows_.push_back(row);
  seen_[row] |= bit;
  return true;
}

void SlantedCuts::forget_seen() {
  for (const std::size_t row : seen_rows_) seen_[row] = 0;
  seen_rows_.clear();
}

/// The cut that the fewest steps lead to, across the axis first, straight on before turning; none if too many cells
/// would have to be looked at.
bool SlantedCuts::cut_near(Sortie& sortie) {
  // Cells beside each other across the axis do not wait for one another: rows there go to and fro.
  std::array<Voxel, 9> steps{last_step_};
  std::ranges::copy(face_steps, steps.begin() + 1);
  std::stable_partition(steps.begin(), steps.begin() + 7, [&](Voxel step) { return dot(step, view_.lean) == 0; });
  steps[7] = view_.lean * -1;
  steps[8] = view_.lean;
  forget_seen();
  see(at_);
  hops_ = {{at_, 0}};
  for (std::size_t hop = 0; hop < hops_.size() && hop < max_hops; ++hop) {
    if (hop == first_hops && !is_any_within(max_window_steps)) return false;
    for (const Voxel step : steps) {
      const Voxel next = hops_[hop].cell + step;
      if (!see(next)) continue;
      const Place place = look_at(next);
      if (place == Place::to_cut && may_cut(next)) {
        walk(hop, sortie);
        cut(next, sortie);
        return true;
      }
      if (place == Place::free) hops_.push_back({next, hop});
    }
  }
  return false;
}

bool SlantedCuts::is_any_within(int steps) {
  drop_stale();
  return std::ranges::any_of(lit_, [&](Voxel cell) {
    for (int along = -steps; along <= steps; ++along)
      if (std::abs(along) + l1(cell - at_, view_.lean * along) <= steps) return true;
    return false;
  });
}

void SlantedCuts::drop_stale() {
  std::erase_if(lit_, [&](Voxel cell) { return look_at(cell) != Place::to_cut; });
}

void SlantedCuts::walk(std::size_t hop, Sortie& sortie) {
  std::vector<Voxel> way;
  for (; hop != 0; hop = hops_[hop].before) way.push_back(hops_[hop].cell);
  std::reverse(way.begin(), way.end());
  for (std::size_t at = 0; at < way.size(); ++at)
    if (at + 1 == way.size() || way[at + 1] - way[at] != way[at] - (at == 0 ? at_ : way[at - 1])) {
      go(way[at], 0, sortie);
    }
}

/// Out along the axis, beside the grid to where the axis leads in to the nearest cut, and in. False if that cannot be
/// done from here, or if nothing is left.
bool SlantedCuts::cut_far(Sortie& sortie) {
  const Voxel out = way_out(at_);
  drop_stale();
  while (!lit_.empty()) {
    const auto nearest = std::min_element(lit_.begin(), lit_.end(), [&](Voxel a, Voxel b) {
      const int far_a = l1(a, at_), far_b = l1(b, at_);
      return far_a != far_b ? far_a < far_b : a < b;
    });
    const Voxel target = *nearest;
    const auto way = route(out, way_out(target));
    if (!way && at_ != gate_) return false;
    if (!way || !may_cut(target)) {
      lit_.erase(nearest);
      continue;
    }
    if (sortie.cuts > 0) {
      go(out, 0, sortie);
      sortie.serves.resize(sortie.strokes.size(), sortie.serves.back());
    }
    for (const Voxel via : *way) go(via, travel_tolerance, sortie);
    go(target + view_.lean, 0, sortie);
    cut(target, sortie);
    return true;
  }
  return false;
}

/// Straight lines beyond the grid from one place to another, both as `way_out` gives them: over one side if both are on
/// it, else by way of the edge between their sides. Nothing if the ball may not be somewhere on them.
std::optional<std::vector<Voxel>> SlantedCuts::route(Voxel out, Voxel in) const {
  const int last = view_.n - 1 + outside_by;
  const auto on = [&](int x, int lean) { return lean != 0 && x == last; };
  const Voxel lean = view_.lean;
  const bool same_side = (on(out.i, lean.i) && on(in.i, lean.i)) || (on(out.j, lean.j) && on(in.j, lean.j)) ||
                         (on(out.k, lean.k) && on(in.k, lean.k));
  Voxel edge = in;
  if (!same_side) {
    if (on(out.i, lean.i)) edge.i = last;
    if (on(out.j, lean.j)) edge.j = last;
    if (on(out.k, lean.k)) edge.k = last;
  }
  if (!is_reachable_between(out, edge) || !is_reachable_between(edge, in)) return std::nullopt;
  return std::vector<Voxel>{edge, in};
}

bool SlantedCuts::is_reachable_between(Voxel from, Voxel to) const {
  const int steps = 1 + 2 * l1(from, to);
  for (int s = 0; s <= steps; ++s)
    if (!reachable_(centre(from) + (static_cast<double>(s) / steps) * (centre(to) - centre(from)))) return false;
  return true;
}

void SlantedCuts::go(Voxel cell, double tolerance, Sortie& sortie) {
  if (cell == at_) return;
  sortie.strokes.push_back({centre(cell), 0, tolerance, {}, {}});
  at_ = cell;
  last_step_ = {};
}

bool SlantedCuts::may_cut(Voxel cell) {
  const Voxel voxel = view_.voxel(cell);
  if (take_(voxel)) return true;
  wanted_.erase(voxel);
  return false;
}

/// From a neighbour, or from the next cell along the axis. A run goes on straight.
void SlantedCuts::cut(Voxel cell, Sortie& sortie) {
  const Voxel step = cell - at_, voxel = view_.voxel(cell);
  const bool goes_on = step == last_step_ && l1(step, {}) == 1 && !sortie.strokes.empty();
  if (goes_on && sortie.strokes.back().count > 0) {
    Stroke& run = sortie.strokes.back();
    run.to = centre(cell);
    run.last = voxel;
    ++run.count;
  } else {
    sortie.strokes.push_back({centre(cell), 1, 0, voxel, voxel});
  }
  sortie.serves.resize(sortie.strokes.size(), sortie.strokes.size() - 1);
  at_ = cell;
  last_step_ = step;
  ++sortie.cuts;
  shadow_.remove(voxel, [&](Voxel lit) { lit_.push_back(view_.cell(lit)); });
}

void SlantedCuts::take_back(const Sortie& sortie) {
  for (const Stroke& stroke : sortie.strokes)
    for_each_cut(stroke, [&](Voxel voxel) {
      shadow_.put_back(voxel);
      lit_.push_back(view_.cell(voxel));
    });
}

void SlantedCuts::give_up(const Stroke& cut) {
  for_each_cut(cut, [&](Voxel voxel) { wanted_.erase(voxel); });
}

}  // namespace sculpt
