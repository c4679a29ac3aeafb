#include "core/mill/finish/rows/middle_curves.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/mill/finish/rows/simplified_curve.hpp"
#include "core/mill/finish/rows/thinning.hpp"

namespace sculpt {
namespace {

/// All in row spacings: branches that are shorter are none, a row along a single cell, how far a curve may be from its
/// smoothed course, from where an exact place draws it, and then from its course between these.
constexpr double shortest_branch = 1, shortest_row = 0.25, off = 0.1, draws = 0.6, off_between = 0.03;
/// From one exact place to the next.
constexpr double exact_spacings = 0.25;
constexpr int smoothings = 8;
/// Where a curve branches it goes on as it went over the last cells.
constexpr std::size_t cells_back = 5;

class Trails {
 public:
  Trails(const Lattice& lattice, const std::vector<char>& skeleton)
      : lattice_(lattice), skeleton_(skeleton), is_left_(skeleton) {}

  /// From where they end first, then from where they branch, rings at last.
  std::vector<Curve> run(double shortest_branch_m) {
    const auto walk_from = [&](const auto& is_begin) {
      for (std::size_t cell = 0; cell < is_left_.size(); ++cell) {
        if (is_left_[cell] == 0 || !is_begin(cell)) continue;
        const auto branch = neighbour_done(cell);
        Curve trail = walk(cell, branch);
        if (!branch || length(trail) >= shortest_branch_m) trails_.push_back(std::move(trail));
      }
    };
    walk_from([&](std::size_t cell) { return branches(skeleton_, lattice_, cell) == 1; });
    walk_from([&](std::size_t cell) { return neighbour_done(cell).has_value(); });
    walk_from([](std::size_t) { return true; });
    return std::move(trails_);
  }

 private:
  Point2 middle(std::size_t cell) const {
    const auto width = static_cast<std::size_t>(lattice_.width);
    return {lattice_.u(static_cast<int>(cell % width)), lattice_.v(static_cast<int>(cell / width))};
  }
  double length(const Curve& trail) const { return static_cast<double>(trail.size() - 1) * lattice_.step; }

  std::optional<std::size_t> neighbour_done(std::size_t cell) const {
    for (const std::size_t next : neighbours(lattice_, cell))
      if (skeleton_[next] != 0 && is_left_[next] == 0) return next;
    return std::nullopt;
  }

  /// Straight on, as far as cells are left; a ring is closed.
  Curve walk(std::size_t cell, std::optional<std::size_t> branch) {
    Curve trail;
    if (branch) trail.push_back(middle(*branch));
    for (std::optional<std::size_t> next = cell; next; next = straight_on(*next, trail)) {
      is_left_[*next] = 0;
      trail.push_back(middle(*next));
    }
    if (!branch && trail.size() > 2 * cells_back && (trail.front() - trail.back()).norm() < 1.5 * lattice_.step)
      trail.push_back(trail.front());
    return trail;
  }

  std::optional<std::size_t> straight_on(std::size_t cell, const Curve& trail) const {
    const Point2 way = trail.back() - trail[trail.size() > cells_back ? trail.size() - 1 - cells_back : 0];
    std::optional<std::size_t> found;
    double best = 0;
    for (const std::size_t next : neighbours(lattice_, cell)) {
      if (is_left_[next] == 0) continue;
      const double straight = way.normalized().dot((middle(next) - trail.back()).normalized());
      if (!found || straight > best + 1e-9) best = straight, found = next;
    }
    return found;
  }

  const Lattice& lattice_;
  const std::vector<char>& skeleton_;
  std::vector<char> is_left_;
  std::vector<Curve> trails_;
};

Curve smoothed(Curve curve) {
  for (int time = 0; time < smoothings; ++time) {
    const Curve before = curve;
    for (std::size_t at = 1; at + 1 < curve.size(); ++at)
      curve[at] = before[at - 1] / 4 + before[at] / 2 + before[at + 1] / 4;
  }
  return curve;
}

/// Exact places by the cells of a lattice.
class ExactPlaces {
 public:
  ExactPlaces(const Lattice& lattice, const std::vector<Point2>& places) : lattice_(lattice), by_cell_(lattice.size()) {
    for (const Point2& place : places)
      if (const int a = lattice.cell_u(place.x()), b = lattice.cell_v(place.y()); lattice.contains(a, b))
        by_cell_[lattice.index(a, b)].push_back(place);
  }

  std::optional<Point2> nearest(const Point2& to, double reach_m) const {
    std::optional<Point2> found;
    double least = reach_m;
    for (int b = lattice_.cell_v(to.y() - reach_m); b <= lattice_.cell_v(to.y() + reach_m); ++b)
      for (int a = lattice_.cell_u(to.x() - reach_m); a <= lattice_.cell_u(to.x() + reach_m); ++a) {
        if (!lattice_.contains(a, b)) continue;
        for (const Point2& place : by_cell_[lattice_.index(a, b)])
          if (const double far = (place - to).norm(); far < least) least = far, found = place;
      }
    return found;
  }

 private:
  const Lattice& lattice_;
  std::vector<std::vector<Point2>> by_cell_;
};

Curve drawn_to(const ExactPlaces& exact, const Curve& curve, double spacing_m) {
  Curve drawn;
  double since = exact_spacings * spacing_m;
  for (std::size_t at = 0; at < curve.size(); ++at) {
    if (at > 0) since += (curve[at] - curve[at - 1]).norm();
    const auto place = exact.nearest(curve[at], draws * spacing_m);
    if (!place) {
      drawn.push_back(curve[at]);
    } else if (since >= exact_spacings * spacing_m || at + 1 == curve.size()) {
      drawn.push_back(*place);
      since = 0;
    }
  }
  return drawn;
}

}  // namespace

std::vector<Curve> middle_curves(PlanPatch patch, const std::vector<Point2>& exact, double spacing_m) {
  if (patch.is_inside.empty()) return {};
  thin(patch.is_inside, patch.lattice);
  const ExactPlaces places(patch.lattice, exact);
  std::vector<Curve> curves = Trails(patch.lattice, patch.is_inside).run(shortest_branch * spacing_m);
  for (Curve& curve : curves) {
    curve = exact.empty()
                ? simplified(smoothed(std::move(curve)), off * spacing_m)
                : simplified(drawn_to(places, smoothed(std::move(curve)), spacing_m), off_between * spacing_m);
    if (curve.size() == 1) curve.push_back(curve.front() + Point2(shortest_row * spacing_m, 0));
  }
  return curves;
}

}  // namespace sculpt
