#include "core/mill/rough/roughing.hpp"

#include <algorithm>
#include <array>

#include "core/mill/drive/hop.hpp"

namespace sculpt {
namespace {

/// What a way through the air costs beside one that cuts.
constexpr double air_share = 0.5;

}  // namespace

std::vector<char> free_cells(const Site& site, double height, const IsReachable& reachable) {
  const Lattice& lattice = site.lattice();
  std::vector<char> free(lattice.size());
  for (int b = 0; b < lattice.height; ++b)
    for (int a = 0; a < lattice.width; ++a) {
      const std::size_t at = lattice.index(a, b);
      const auto limit = static_cast<double>(std::max(site.limit().heights[at], site.body_limit().heights[at]));
      free[at] = limit <= height && reachable({lattice.u(a), lattice.v(b), height});
    }
  return free;
}

namespace {

struct LevelPlan {
  std::vector<MillStroke> strokes;
  double length_m = 0, taken_m3 = 0;
};

LevelPlan plan_level(const Site& site, const ClearingTask& level, RowLayout layout, const LevelWays& ways,
                     StockTop& surface) {
  LevelPlan plan;
  const double height = level.height;
  Clearing clearing(level, layout, surface);
  if (clearing.volume_to_clear() < min_pass_m3(level.tool)) return plan;
  Vec3 tip = ways.from;
  while (const auto pass = clearing.next_from(tip.head<2>(), tip.z() == height)) {
    const Vec3 begin(pass->front().x(), pass->front().y(), height);
    if (tip != begin) hop(site, tip, begin, ways.min_height, ways.stray_m, plan.strokes);
    for (std::size_t edge = 1; edge < pass->size(); ++edge)
      plan.strokes.push_back({site.frame().point({(*pass)[edge].x(), (*pass)[edge].y(), height}), true, ways.stray_m});
    tip = {pass->back().x(), pass->back().y(), height};
  }
  plan.taken_m3 = clearing.taken_m3();
  Vec3 at = site.frame().point(ways.from);
  for (const MillStroke& stroke : plan.strokes) {
    plan.length_m += (stroke.tip_m - at).norm() * (stroke.cut ? 1 : air_share);
    at = stroke.tip_m;
  }
  return plan;
}

}  // namespace

std::vector<MillStroke> rough_level(const Site& site, const ClearingTask& level, const LevelWays& ways,
                                    StockTop& surface, const Helpers& helpers) {
  constexpr std::array layouts{RowLayout::around, RowLayout::along_u, RowLayout::along_v};
  std::vector<StockTop> left(layouts.size(), surface);
  std::vector<LevelPlan> plans(layouts.size());
  helpers.for_each_index(layouts.size(), [&](std::size_t number) {
    plans[number] = plan_level(site, level, layouts[number], ways, left[number]);
  });
  const auto best = std::ranges::max_element(
      plans, {}, [](const LevelPlan& plan) { return plan.strokes.empty() ? 0 : plan.taken_m3 / plan.length_m; });
  surface = std::move(left[static_cast<std::size_t>(best - plans.begin())]);
  return std::move(best->strokes);
}

}  // namespace sculpt
