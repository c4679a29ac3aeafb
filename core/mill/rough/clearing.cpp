#include "core/mill/rough/clearing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/mill/rough/cell_distances.hpp"

namespace sculpt {
namespace {

constexpr double pi = std::numbers::pi;
/// Of the cutter's radius: how long an edge is.
constexpr double step_share = 0.4;
/// Steps that take off less than this share of the cap end a pass; the first is for what makes most of the volume.
constexpr std::array thresholds{0.3, 0.08};
/// Of the cutter's disc, that ways between passes may cut through.
constexpr double little_share = 0.06;
constexpr std::size_t max_steps = 100000, max_idle_steps = 5;
constexpr double turn_step = 7.5 * pi / 180, turn_ahead = 100 * pi / 180;
/// Of an edge's length: what going the wrong way around costs.
constexpr double wrong_side = 0.6;

}  // namespace

Clearing::Clearing(const ClearingTask& task, StockTop& surface)
    : task_(task),
      surface_(surface),
      lattice_(surface.lattice()),
      step_m_(std::max(step_share * task.tool.cutter.radius_m, 2 * lattice_.step)),
      cap_m3_m_(task.tool.max_depth_m * task.tool.max_width_m),
      beside_m_(task.tool.cutter.radius_m - task.tool.max_width_m),
      threshold_(thresholds.front()),
      stands_above_(static_cast<float>(task.height + task.cusp_share * task.tool.max_depth_m)),
      stands_(lattice_.size()),
      touching_(lattice_.size()),
      distance_(lattice_.size()),
      tried_(lattice_.size()),
      seen_(lattice_.size()),
      parent_(lattice_.size()) {
  reach_ = static_cast<int>(task.tool.cutter.radius_m / lattice_.step) + 1;
  for (int db = -reach_; db <= reach_; ++db) {
    int half = reach_;
    while (half >= 0 && std::hypot(half, db) * lattice_.step > task.tool.cutter.radius_m) --half;
    disc_.push_back(half);
    little_ = static_cast<std::uint16_t>(little_ + 2 * half + 1);
  }
  little_ = static_cast<std::uint16_t>(little_ * little_share);
  far_ = reach_ + static_cast<int>(2 * step_m_ / lattice_.step) + 2;
  find_reachable();
  count_touching();
}

/// What is higher than the cutter would leave it if it came to all places where it may be, by more than a cusp.
void Clearing::find_reachable() {
  const std::vector<float> to_free = distances_to(task_.is_free, lattice_, far_);
  const Cutter& cutter = task_.tool.cutter;
  const double to_corner = std::numbers::sqrt2 * lattice_.step;
  for (std::size_t at = 0; at < stands_.size(); ++at) {
    if (surface_.map().heights[at] <= stands_above_) continue;
    const double r = static_cast<double>(to_free[at]) + to_corner;
    stands_[at] =
        r<cutter.radius_m&& static_cast<double>(surface_.map().heights[at]) - cutter.height_m(r)> static_cast<double>(
            stands_above_);
  }
}

double Clearing::volume_to_clear() const {
  double heights = 0;
  for (std::size_t at = 0; at < stands_.size(); ++at)
    if (stands_[at]) heights += static_cast<double>(surface_.map().heights[at]) - task_.height;
  return heights * lattice_.step * lattice_.step;
}

/// Between the middles of cells.
double Clearing::distance(const Point2& p) const {
  const double x = (p.x() - lattice_.low_u) / lattice_.step - 0.5, y = (p.y() - lattice_.low_v) / lattice_.step - 0.5;
  const int a = std::clamp(static_cast<int>(std::floor(x)), 0, lattice_.width - 2),
            b = std::clamp(static_cast<int>(std::floor(y)), 0, lattice_.height - 2);
  const double s = std::clamp(x - a, 0.0, 1.0), t = std::clamp(y - b, 0.0, 1.0);
  const auto at = [&](int da, int db) { return static_cast<double>(distance_[lattice_.index(a + da, b + db)]); };
  return (1 - t) * ((1 - s) * at(0, 0) + s * at(1, 0)) + t * ((1 - s) * at(0, 1) + s * at(1, 1));
}

void Clearing::count_touching() {
  std::vector<std::uint16_t> sums(static_cast<std::size_t>(lattice_.width) + 1);
  for (int b = 0; b < lattice_.height; ++b) {
    bool any = false;
    for (int a = 0; a < lattice_.width; ++a) {
      const bool stands = stands_[lattice_.index(a, b)] != 0;
      any = any || stands;
      sums[static_cast<std::size_t>(a) + 1] =
          static_cast<std::uint16_t>(sums[static_cast<std::size_t>(a)] + (stands ? 1 : 0));
    }
    if (!any) continue;
    for (int db = -reach_; db <= reach_; ++db) {
      const int row = b - db, half = disc_[static_cast<std::size_t>(db + reach_)];
      if (half < 0 || row < 0 || row >= lattice_.height) continue;
      std::uint16_t* touching = touching_.data() + lattice_.index(0, row);
      for (int a = 0; a < lattice_.width; ++a) {
        const int last = std::min(lattice_.width, a + half + 1), first = std::max(0, a - half);
        touching[a] = static_cast<std::uint16_t>(touching[a] + sums[static_cast<std::size_t>(last)] -
                                                 sums[static_cast<std::size_t>(first)]);
      }
    }
  }
}

void Clearing::untouch(std::size_t at) {
  const int a = static_cast<int>(at) % lattice_.width, b = static_cast<int>(at) / lattice_.width;
  for (int db = -reach_; db <= reach_; ++db) {
    const int row = b + db, half = disc_[static_cast<std::size_t>(db + reach_)];
    if (half < 0 || row < 0 || row >= lattice_.height) continue;
    std::uint16_t* touching = touching_.data() + lattice_.index(0, row);
    for (int c = std::max(0, a - half); c <= std::min(lattice_.width - 1, a + half); ++c) --touching[c];
  }
}

void Clearing::cut(const Point2& from, const Point2& to) {
  surface_.cut(at_level(from), at_level(to), [&](std::size_t at, float before) {
    if (!stands_[at] || surface_.map().heights[at] > stands_above_ || before <= stands_above_) return;
    stands_[at] = 0;
    is_measured_ = false;
    untouch(at);
  });
}

double Clearing::volume(const Point2& from, const Point2& to) const {
  return surface_.volume(at_level(from), at_level(to));
}

bool Clearing::edge_is_free(const Point2& from, const Point2& to) const {
  bool free = lattice_.contains(lattice_.cell_u(to.x()), lattice_.cell_v(to.y()));
  for_each_cell_near(lattice_, at_level(from), at_level(to), 0,
                     [&](int a, int b) { free = free && task_.is_free[lattice_.index(a, b)]; });
  return free;
}

bool Clearing::edge_is_open(const Point2& from, const Point2& to) const {
  bool open = true;
  for_each_cell_near(lattice_, at_level(from), at_level(to), 0,
                     [&](int a, int b) { open = open && is_open(lattice_.index(a, b)); });
  return open;
}

/// In the open, beside where the cutter touches something.
bool Clearing::may_begin(int a, int b) const {
  const std::size_t at = lattice_.index(a, b);
  if (!is_open(at) || tried_[at]) return false;
  for (const auto& [da, db] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    if (!lattice_.contains(a + da, b + db)) continue;
    const std::size_t beside = lattice_.index(a + da, b + db);
    if (task_.is_free[beside] && touching_[beside] > little_) return true;
  }
  return false;
}

std::optional<Point2> Clearing::find_entry(const Point2& at) const {
  std::optional<Point2> nearest;
  for (int b = 0; b < lattice_.height; ++b)
    for (int a = 0; a < lattice_.width; ++a) {
      if (!may_begin(a, b)) continue;
      const Point2 place(lattice_.u(a), lattice_.v(b));
      if (!nearest || (place - at).squaredNorm() < (*nearest - at).squaredNorm()) nearest = place;
    }
  return nearest;
}

bool Clearing::lower_threshold() {
  const auto next = std::ranges::find_if(thresholds, [this](double each) { return each < threshold_; });
  if (next == thresholds.end()) return false;
  threshold_ = *next;
  std::ranges::fill(tried_, 0);
  return true;
}

/// Of the headings not farther than `widest_turn` from this one that which keeps best to where the pass should be, what
/// stands on its left, if the edge is free and takes off no more than it may.
std::optional<Clearing::Step> Clearing::best_step(const Point2& from, double heading, double widest_turn) const {
  struct Choice {
    double cost, heading;
  };
  std::vector<Choice> choices;
  const int turns = static_cast<int>(widest_turn / turn_step);
  const double here = distance(from);
  for (int turn = -turns; turn <= turns; ++turn) {
    const double towards = heading + turn * turn_step;
    const Point2 way(std::cos(towards), std::sin(towards)), to = from + step_m_ * way, left(-way.y(), way.x());
    // Along what stands, that on the left is nearer than that on the right.
    const double side = distance(from + step_m_ / 2 * (way + left)) - distance(from + step_m_ / 2 * (way - left));
    double cost = std::abs(distance(to) - beside_m_) + 1e-3 * std::abs(turn) * step_m_;
    if (side > 0 && here < 2 * step_m_ + std::max(0.0, beside_m_)) cost += wrong_side * step_m_;
    choices.push_back({cost, towards});
  }
  std::ranges::sort(choices, {}, &Choice::cost);
  for (const Choice& choice : choices) {
    Step step{from + step_m_ * Point2(std::cos(choice.heading), std::sin(choice.heading)), choice.heading, 0};
    if (!edge_is_free(from, step.to)) continue;
    step.volume = volume(from, step.to);
    if (step.volume <= cap_m3_m_ * step_m_) return step;
  }
  return std::nullopt;
}

/// Edges that take off next to nothing wait until one comes that takes off enough; those at the end are dropped.
void Clearing::follow(LevelPass& pass) {
  double heading = 0, turn = pi;
  std::vector<Point2> waiting;
  for (std::size_t n = 0; n < max_steps && waiting.size() <= max_idle_steps; ++n) {
    const Point2 from = waiting.empty() ? pass.back() : waiting.back();
    const auto step = best_step(from, heading, turn);
    if (!step) return;
    heading = step->heading;
    turn = turn_ahead;
    waiting.push_back(step->to);
    if (step->volume < threshold_ * cap_m3_m_ * step_m_) continue;
    for (const Point2& to : waiting) {
      cut(pass.back(), to);
      pass.push_back(to);
    }
    waiting.clear();
  }
}

/// Fewer edges through what is open.
std::vector<Point2> Clearing::straightened(const std::vector<Point2>& way) const {
  std::vector<Point2> straight{way.front()};
  for (std::size_t at = 0; at + 1 < way.size();) {
    std::size_t next = at + 1;
    for (std::size_t stride = 2; at + stride < way.size() && edge_is_open(way[at], way[at + stride]); stride *= 2)
      next = at + stride;
    for (std::size_t stride = (next - at) / 2; stride > 0; stride /= 2)
      if (next + stride < way.size() && edge_is_open(way[at], way[next + stride])) next += stride;
    straight.push_back(way[next]);
    at = next;
  }
  return straight;
}

/// Breadth-first through open cells to the nearest place where a pass may begin, from where one then does.
std::optional<LevelPass> Clearing::next_from(const Point2& at) {
  const int a0 = lattice_.cell_u(at.x()), b0 = lattice_.cell_v(at.y());
  if (!lattice_.contains(a0, b0)) return std::nullopt;
  ++search_;
  std::vector<std::uint32_t> queue{static_cast<std::uint32_t>(lattice_.index(a0, b0))};
  seen_[queue.front()] = search_;
  parent_[queue.front()] = -1;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const std::size_t here = queue[head];
    const int a = static_cast<int>(here) % lattice_.width, b = static_cast<int>(here) / lattice_.width;
    if (may_begin(a, b)) {
      std::vector<Point2> way;
      for (std::int32_t back = static_cast<std::int32_t>(here); parent_[static_cast<std::size_t>(back)] >= 0;
           back = parent_[static_cast<std::size_t>(back)])
        way.emplace_back(lattice_.u(back % lattice_.width), lattice_.v(back / lattice_.width));
      way.push_back(at);
      std::ranges::reverse(way);
      LevelPass pass = straightened(way);
      const std::size_t before = pass.size();
      bool is_allowed = true;
      for (std::size_t edge = 0; edge + 1 < before && is_allowed; ++edge)
        is_allowed = volume(pass[edge], pass[edge + 1]) <= cap_m3_m_ * (pass[edge + 1] - pass[edge]).norm();
      if (is_allowed) {
        for (std::size_t edge = 0; edge + 1 < before; ++edge) cut(pass[edge], pass[edge + 1]);
        if (!is_measured_) {
          distance_ = distances_to(stands_, lattice_, far_);
          is_measured_ = true;
        }
        follow(pass);
      }
      tried_[here] = 1;
      if (pass.size() > before) return pass;
    }
    for (const auto& [da, db] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      if (!lattice_.contains(a + da, b + db)) continue;
      const std::size_t beside = lattice_.index(a + da, b + db);
      if (seen_[beside] == search_ || !is_open(beside)) continue;
      seen_[beside] = search_;
      parent_[beside] = static_cast<std::int32_t>(here);
      queue.push_back(static_cast<std::uint32_t>(beside));
    }
  }
  return std::nullopt;
}

}  // namespace sculpt
