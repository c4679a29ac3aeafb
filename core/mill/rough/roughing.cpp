#include "core/mill/rough/roughing.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "core/mill/drive/hop.hpp"
#include "core/mill/rough/cells_to_clear.hpp"

namespace sculpt {
namespace {

/// What a way through the air costs beside one that cuts.
constexpr double air_share = 0.5;

}  // namespace

std::vector<char> free_cells(const Site& site, double height, const IsReachable& reachable, const Helpers& helpers) {
  const Lattice& lattice = site.lattice();
  std::vector<char> free(lattice.size());
  helpers.for_each_index(static_cast<std::size_t>(lattice.height), [&](std::size_t row) {
    const int b = static_cast<int>(row);
    for (int a = 0; a < lattice.width; ++a) {
      const std::size_t at = lattice.index(a, b);
      free[at] = site.lowest_tip(at) <= height && reachable({lattice.u(a), lattice.v(b), height});
    }
  });
  return free;
}

namespace {

/// How far apart places are at which the robot is asked whether it holds the tip.
constexpr double asked_m = 5e-3;

/// The way over, by the first of the heights that the robot can go; nothing if there is none.
std::vector<MillStroke> way_over(const Site& site, const LevelWays& ways, const Vec3& from, const Vec3& to) {
  const auto is_reachable = [&](const std::vector<MillStroke>& strokes) {
    Vec3 at = from;
    return std::ranges::all_of(strokes, [&](const MillStroke& stroke) {
      const Vec3 begin = std::exchange(at, site.frame().of(stroke.tip_m));
      const int steps = std::max(1, static_cast<int>(std::ceil((at - begin).norm() / asked_m)));
      for (int step = 1; step <= steps; ++step)
        if (!ways.reachable(begin + (at - begin) * step / steps)) return false;
      return true;
    });
  };
  for (const double min_height : ways.min_heights) {
    std::vector<MillStroke> strokes;
    hop(site, from, to, min_height, ways.stray_m, strokes);
    if (is_reachable(strokes)) return strokes;
  }
  return {};
}

/// The length of cut that they are worth (m). `from`: in the stock's frame.
double length_of(const std::vector<MillStroke>& strokes, Vec3 from) {
  double length = 0;
  for (const MillStroke& stroke : strokes)
    length += (stroke.tip_m - std::exchange(from, stroke.tip_m)).norm() * (stroke.cut ? 1 : air_share);
  return length;
}

struct LevelPlan {
  std::vector<MillStroke> strokes;
  double length_m = 0, taken_m3 = 0;
  bool is_cut_off = false;
};

LevelPlan plan_level(const Site& site, const RoughLevel& level, const std::vector<char>& stands, RowLayout layout,
                     const LevelWays& ways, StockTop& surface) {
  LevelPlan plan;
  const double height = level.height;
  Vec3 tip = ways.from;
  const auto way_over_m = [&](const Vec3& to) -> std::optional<double> {
    const std::vector<MillStroke> over = way_over(site, ways, tip, to);
    plan.is_cut_off = plan.is_cut_off || over.empty();
    return over.empty() ? std::nullopt : std::optional(length_of(over, site.frame().point(tip)));
  };
  Clearing clearing({level.tool, height, cusp_m(level.tool), level.is_free, stands, level.seam_m, way_over_m}, layout,
                    surface);
  while (const auto pass = clearing.next_from(tip.head<2>(), tip.z() == height)) {
    if (tip != pass->front())
      std::ranges::move(way_over(site, ways, tip, pass->front()), std::back_inserter(plan.strokes));
    for (auto place = pass->begin() + 1; place != pass->end(); ++place)
      plan.strokes.push_back({site.frame().point(*place), true, ways.stray_m});
    tip = pass->back();
  }
  plan.taken_m3 = clearing.taken_m3();
  plan.length_m = length_of(plan.strokes, site.frame().point(ways.from));
  return plan;
}

/// Of the places where the tip would take something off at a level: at how many does it go deeper afterwards? What is
/// left there keeps it from all that is below.
double lid_share(const Site& site, const RoughLevel& level, const std::vector<char>& stands) {
  int all = 0, lids = 0;
  for (std::size_t at = 0; at < stands.size(); ++at) {
    if (!stands[at] || !level.wanted[at]) continue;
    ++all;
    lids += site.lowest_tip(at) <= level.height - level.tool.max_depth_m;
  }
  return all > 0 ? static_cast<double>(lids) / all : 0;
}

}  // namespace

LevelStrokes rough_level(const Site& site, const RoughLevel& level, const LevelWays& ways, StockTop& surface,
                         const Helpers& helpers) {
  const CellsToClear cells =
      find_cells_to_clear(level.tool.cutter, level.height, cusp_m(level.tool), level.wanted, surface.map(), helpers);
  if (cells.volume_m3 < min_pass_m3(level.tool)) return {};
  constexpr std::array layouts{RowLayout::around, RowLayout::along_u, RowLayout::along_v};
  std::vector<StockTop> left(layouts.size(), surface);
  std::vector<LevelPlan> plans(layouts.size());
  helpers.for_each_index(layouts.size(), [&](std::size_t number) {
    plans[number] = plan_level(site, level, cells.marked, layouts[number], ways, left[number]);
  });
  const auto best = std::ranges::max_element(
      plans, {}, [](const LevelPlan& plan) { return plan.strokes.empty() ? 0 : plan.taken_m3 / plan.length_m; });
  const double enough = (1 - lid_share(site, level, cells.marked)) * level.min_engagement;
  if (best->taken_m3 < enough * level.tool.max_depth_m * level.tool.max_width_m * best->length_m)
    return {{}, best->is_cut_off};
  surface = std::move(left[static_cast<std::size_t>(best - plans.begin())]);
  return {std::move(best->strokes), best->is_cut_off};
}

}  // namespace sculpt
