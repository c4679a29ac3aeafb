#include "core/mill/rough/rough_stage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/mill/drive/mill_follow.hpp"
#include "core/mill/rough/roughing.hpp"

namespace sculpt {
namespace {

/// Lattices: cells of a cutter's radius, and no finer than this.
constexpr double cells_a_radius = 12, finest_cell_m = 2.5e-4;
/// Of a cutter's radius, left by roughing.
constexpr double rough_share = 0.03;
/// A direction is worth its while from this share of the stock's volume on; to a ball, which takes off less than that
/// when it finishes, from so many passes on.
constexpr double min_gain_share = 1e-3, min_gain_passes = 15;
/// Voxels that are looked at to find that out, along an edge.
constexpr int samples_along = 64;
/// Of a ball's depth of cut: what stands less above the lowest that it comes to is for finishing.
constexpr double finished_share = 0.25;
constexpr int max_failures = 12;
/// Of a depth of cut: what is a large voxel.
constexpr double large_voxel_share = 0.5;
/// What is less uneven is flat.
constexpr double flat_m = 1e-4;
/// Of depth times width of cut, what a level must give: where no other tool comes after this one, and at most.
constexpr double least_engagement = 0.15, most_engagement = 0.3;
/// Of rows over one level: a rib that is left stands the higher the deeper the levels beside it, until no row may take
/// it off any more.
constexpr int max_rounds = 3;

class RoughStage {
 public:
  RoughStage(const MillJob& job, Carver& carver, const RunContext& run) : job_(job), carver_(carver), run_(run) {}

  void run() {
    find_prospects();
    std::vector<char> used_up(mill_directions().size());
    while (const auto best = best_direction(used_up)) {
      used_up[*best] = 1;
      rough_along(*best);
    }
  }

 private:
  const MillTool& tool() const { return carver_.tool(); }
  double stray_m() const { return job_.wishes.stray_m(); }
  double step_m() const { return std::max(finest_cell_m, tool().cutter.radius_m / cells_a_radius); }
  /// What a later tool would take off in the same time, if it had as much before it as it may take.
  double min_engagement() const {
    const auto rate = [](const MillTool& each) { return each.max_depth_m * each.max_width_m * each.feed_m_s; };
    double later = 0;
    for (auto each = job_.tools.rbegin(); each != job_.tools.rend() && each->name != tool().name; ++each)
      later = std::max(later, rate(*each));
    return std::clamp(later / rate(tool()), least_engagement, most_engagement);
  }
  SiteMargins margins() const { return {rough_share * tool().cutter.radius_m + stray_m(), body_margin_m}; }

  void find_samples(int stride) {
    VoxelSet wanted = carver_.left().voxels();
    wanted -= job_.voxels.keep;
    for (int k = stride / 2; k < job_.grid.n; k += stride)
      for (int j = stride / 2; j < job_.grid.n; j += stride)
        for (int i = stride / 2; i < job_.grid.n; i += stride)
          if (wanted.contains({i, j, k})) samples_.push_back({i, j, k});
  }

  /// Of each direction which of some voxels that are to be removed the tool comes to.
  void find_prospects() {
    const int stride = std::max(1, job_.grid.n / samples_along);
    find_samples(stride);
    const bool is_ball = tool().cutter.kind == CutterKind::ball;
    const double above = is_ball ? finished_share * tool().max_depth_m : 0;
    prospects_.resize(mill_directions().size());
    run_.helpers.for_each_index(prospects_.size(), [&](std::size_t number) {
      const auto site = carver_.make_site(number, margins(), 2 * step_m());
      const HeightMap& lowest = site->lowest_cut();
      for (const Voxel sample : samples_) {
        const Vec3 at = site->frame().of(job_.grid.centre(sample));
        const int a = lowest.lattice.cell_u(at.x()), b = lowest.lattice.cell_v(at.y());
        prospects_[number].push_back(lowest.lattice.contains(a, b) &&
                                     at.z() > static_cast<double>(lowest.at(a, b)) + above);
      }
    });
    min_gain_ = min_gain_share * std::pow(job_.grid.n / stride, 3);
    if (is_ball)
      min_gain_ = std::max(min_gain_, min_gain_passes * min_pass_m3(tool()) / std::pow(stride * job_.grid.voxel_m, 3));
  }

  std::optional<std::size_t> best_direction(const std::vector<char>& used_up) const {
    std::vector<std::size_t> gains(mill_directions().size());
    for (std::size_t number = 0; number < gains.size(); ++number)
      for (std::size_t at = 0; at < samples_.size() && !used_up[number]; ++at)
        gains[number] += prospects_[number][at] && carver_.left().voxels().contains(samples_[at]);
    const auto most = std::ranges::max_element(gains);
    if (static_cast<double>(*most) < min_gain_) return std::nullopt;
    return static_cast<std::size_t>(most - gains.begin());
  }

  /// Where the tool might go in a direction.
  std::vector<Vec3> places_left(std::size_t direction) const {
    std::vector<Vec3> places;
    for (std::size_t at = 0; at < samples_.size(); ++at)
      if (prospects_[direction][at] && carver_.left().voxels().contains(samples_[at]))
        places.push_back(job_.grid.centre(samples_[at]));
    return places;
  }

  void see(Site& site) {
    site.see(carver_.standing(), job_.grid, run_.helpers);
    seen_cuts_ = carver_.cuts();
  }
  /// Those since it saw last what stands, if there are any.
  void see_cuts(Site& site) {
    if (seen_cuts_ != carver_.cuts()) see(site);
  }

  void rough_along(std::size_t number) {
    const auto site = carver_.make_site(number, margins(), step_m());
    see(*site);
    if (!carver_.enter(number, *site, places_left(number))) return;
    StockTop surface = surface_of(*site);
    const double top = site->top();
    const double bottom = carver_.bottom(site->frame());
    for (double height = top - tool().max_depth_m; height > bottom - tool().cutter.radius_m;
         height -= tool().max_depth_m) {
      if (const auto flat = flat_above(*site, surface, height)) rough_level_along(*site, surface, *flat, height);
      rough_level_along(*site, surface, height, -std::numeric_limits<double>::infinity());
    }
    carver_.draw_back(*site);
  }

  /// What is to be cut and can be: not all that may stand.
  StockTop surface_of(const Site& site) const {
    return {
        heights_of(carver_.left().voxels(), job_.grid, site.frame(), site.lattice(), run_.helpers, &site.lowest_cut()),
        tool().cutter, stray_m()};
  }

  /// After rows as they were planned: what was cut may have been hollow below, and what two sweep by halves stands
  /// after all. Where voxels are large that would be cut over and over.
  StockTop surface_after(const Site& site, const StockTop& planned) const {
    StockTop surface = surface_of(site);
    if (job_.grid.voxel_m > large_voxel_share * tool().max_depth_m) surface.lower_to(planned.map());
    return surface;
  }

  /// Would the tool, if it came everywhere down to this height, take off enough for a pass?
  bool is_worth_it(const Site& site, const StockTop& surface, double height) const {
    double volume = 0;
    const double cusp = cusp_m(tool()), cell = std::pow(site.lattice().step, 2);
    const std::vector<float>&tops = surface.map().heights, &lowest = site.lowest_cut().heights;
    for (std::size_t at = 0; at < tops.size(); ++at) {
      const double left = std::max(height, static_cast<double>(lowest[at]));
      if (static_cast<double>(tops[at]) > left + cusp) volume += (static_cast<double>(tops[at]) - left) * cell;
    }
    return volume >= min_pass_m3(tool());
  }

  /// The height of what is flat of the part, lies above this one and less than a depth of cut, and has much on it.
  std::optional<double> flat_above(const Site& site, const StockTop& surface, double height) const {
    const double depth = tool().max_depth_m, cell = std::pow(site.lattice().step, 2);
    std::vector<double> volumes(static_cast<std::size_t>(depth / flat_m) + 2);
    for (std::size_t at = 0; at < site.lattice().size(); ++at) {
      const double limit = site.lowest_tip(at) - height,
                   stands = std::min(static_cast<double>(surface.map().heights[at]) - height, depth) - limit;
      if (limit > 0 && stands > cusp_m(tool())) volumes[static_cast<std::size_t>(limit / flat_m)] += stands * cell;
    }
    // It may lie where two of them meet.
    std::size_t most = 1;
    for (std::size_t at = 1; at < volumes.size(); ++at)
      if (volumes[at - 1] + volumes[at] > volumes[most - 1] + volumes[most]) most = at;
    if (volumes[most - 1] + volumes[most] < min_pass_m3(tool())) return std::nullopt;
    return height + static_cast<double>(most + 1) * flat_m;
  }

  /// Of these cells those where the tip may not come down to a height.
  static std::vector<char> cells_above(const Site& site, std::vector<char> cells, double height) {
    for (std::size_t at = 0; at < cells.size(); ++at) cells[at] &= site.lowest_tip(at) > height;
    return cells;
  }

  /// `next`: the next level's height, if what the tool comes to there is left to it.
  void rough_level_along(Site& site, StockTop& surface, double height, double next) {
    if (!is_worth_it(site, surface, height)) return;
    see_cuts(site);
    const IsReachable reachable = [this](const Vec3& at) { return carver_.reach().allows(at); };
    std::vector<char> free = free_cells(site, height, reachable, run_.helpers);
    std::vector<char> wanted = cells_above(site, free, next);
    std::array min_heights{height, carver_.hub().z()};
    bool is_drawn_back = false;
    for (int rounds = 0, failures = 0; rounds < max_rounds && failures < max_failures;) {
      const auto [strokes, is_cut_off] = rough_level(
          site, {tool(), height, free, wanted, cube_margin_m(stray_m(), job_.grid.voxel_m), min_engagement()},
          {carver_.tip(site), min_heights, stray_m(), reachable}, surface, run_.helpers);
      if (strokes.empty()) {
        if (!is_cut_off || std::exchange(is_drawn_back, true)) return;
        carver_.draw_back(site);  // from above everything it may come there
        continue;
      }
      const std::size_t done = carver_.carry_out(strokes);
      if (done == strokes.size()) {
        surface = surface_after(site, surface);
        ++rounds;
        continue;
      }
      ++failures;
      // Not there, then, and what was to come after it is planned anew.
      if (!strokes[done].cut) min_heights[0] = carver_.hub().z();
      const Vec3 refused = site.frame().of(strokes[done].tip_m);
      for_each_cell_near(site.lattice(), refused, refused, tool().cutter.radius_m / 2, [&](int a, int b) {
        free[site.lattice().index(a, b)] = wanted[site.lattice().index(a, b)] = 0;
      });
      if (done == 0) carver_.draw_back(site);
      see(site);
      surface = surface_of(site);
    }
  }

  const MillJob& job_;
  Carver& carver_;
  const RunContext& run_;
  std::vector<Voxel> samples_;
  std::vector<std::vector<char>> prospects_;
  double min_gain_ = 0;
  std::uint64_t seen_cuts_ = 0;  ///< when the site saw last what stands
};

}  // namespace

void rough(const MillJob& job, Carver& carver, const RunContext& run) {
  RoughStage(job, carver, run).run();
}

}  // namespace sculpt
