#include "core/mill/mill.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/mill/drive/mill_arm.hpp"
#include "core/mill/drive/reach_floor.hpp"
#include "core/mill/map/fixtures.hpp"
#include "core/mill/rough/roughing.hpp"
#include "core/mill/tool_meter.hpp"

namespace sculpt {
namespace {

/// Beyond the stock the tip needs room for its cutter and to turn around in.
constexpr double room_beside_m = 8e-3, room_around_m = 0.05;
/// Lattices: cells of a cutter's radius, and no finer than this.
constexpr double cells_a_radius = 12, finest_cell_m = 4e-4;
/// Of a cutter's radius, left by roughing.
constexpr double rough_share = 0.03;
/// A direction is worth its while from this share of the stock's volume on.
constexpr double least_gain_share = 1e-3;
/// Voxels that are looked at to find that out, along an edge.
constexpr int samples_along = 64;
constexpr int max_failures = 12;

Vec3 point_of(const QuantaPoint& tip) {
  return Vec3(static_cast<double>(tip[0]), static_cast<double>(tip[1]), static_cast<double>(tip[2])) / 1e7;
}

QuantaPoint quanta_of(const Vec3& point) {
  return {std::llround(point.x() * 1e7), std::llround(point.y() * 1e7), std::llround(point.z() * 1e7)};
}

class Mill {
 public:
  Mill(const MillJob& job, const std::function<void(std::vector<Keyframe>)>& emit, const RunContext& run)
      : job_(job),
        run_(run),
        stock_(job.voxels.stock, job.grid),
        to_remove_(job.voxels.stock.size() - job.voxels.keep.size()),
        fixtures_(fixture_mesh(job.cell)),
        emit_([this, &emit](std::vector<Keyframe> keyframes) {
          count(keyframes);
          emit(std::move(keyframes));
        }),
        arm_(job.home, job.home, emit_, run) {
    double widest_m = 0;
    for (const MillTool& tool : job.tools) widest_m = std::max(widest_m, tool.cutter.radius_m);
    around_ = grid_around(job.grid, widest_m + room_around_m);
  }

  MillResult run() {
    MillResult result;
    for (std::size_t number = 0; number < job_.tools.size(); ++number) {
      const MillTool& tool = job_.tools[number];
      auto held = std::make_unique<HeldTool>(job_.cell, tool, job_.grid, around_);
      meter_ = std::make_unique<ToolMeter>(tool, std::pow(job_.grid.voxel_m, 3));
      arm_.take_tool(static_cast<int>(number), *held);  // the one before is there until then
      held_ = std::move(held);
      rough();
      if (number + 1 == job_.tools.size()) arm_.go_home();
      result.tools.push_back(meter_->take());
    }
    result.left = stock_.left();
    result.standing = stock_.standing();
    return result;
  }

 private:
  const MillTool& tool() const { return held_->assembly().tool; }

  void count(const std::vector<Keyframe>& keyframes) {
    for (const Keyframe& keyframe : keyframes) {
      const MillStep& step = *keyframe.mill;
      std::optional<Vec3> tip;
      if (step.is_placed()) tip = point_of(step.tip);
      meter_->count(keyframe, tip && tip_ ? (*tip - *tip_).norm() : 0);
      tip_ = tip;
    }
    run_.watch.step(Stage::plan, removed_, to_remove_);
  }

  /// Direction after direction, the one with most to gain first.
  void rough() {
    std::vector<char> used_up(mill_directions().size());
    for (;;) {
      const auto best = best_direction(used_up);
      if (!best) return;
      used_up[*best] = 1;
      rough_along(*best);
    }
  }

  std::unique_ptr<Site> make_site(std::size_t number, double allowance_m, double step_m) const {
    const ToolFrame frame(mill_directions()[number]);
    const double size = job_.grid.n * job_.grid.voxel_m;
    const Assembly& assembly = held_->assembly();
    const double margin = std::max(assembly.radius_m(), tool().cutter.radius_m + room_beside_m) + 2 * step_m;
    auto site = std::make_unique<Site>(
        frame, lattice_over(frame, job_.grid.origin_m, job_.grid.origin_m + Vec3::Constant(size), margin, step_m),
        assembly, job_.part, fixtures_, SiteMargins{allowance_m + cut_stray_m, air_clearance_m / 2});
    site->see(stock_.standing(), job_.grid);
    return site;
  }

  double rough_step_m() const { return std::max(finest_cell_m, tool().cutter.radius_m / cells_a_radius); }

  std::optional<std::size_t> best_direction(const std::vector<char>& used_up) {
    const double coarse_m = 2 * rough_step_m();
    std::vector<Vec3> samples;
    const int stride = std::max(1, job_.grid.n / samples_along);
    VoxelSet wanted = stock_.left();
    wanted -= job_.voxels.keep;
    for (int k = stride / 2; k < job_.grid.n; k += stride)
      for (int j = stride / 2; j < job_.grid.n; j += stride)
        for (int i = stride / 2; i < job_.grid.n; i += stride)
          if (wanted.contains({i, j, k})) samples.push_back(job_.grid.centre({i, j, k}));
    std::vector<std::size_t> gains(mill_directions().size());
    run_.helpers.for_each_index(gains.size(), [&](std::size_t number) {
      if (used_up[number]) return;
      const auto site = make_site(number, rough_share * tool().cutter.radius_m, coarse_m);
      const HeightMap& lowest = site->lowest_cut();
      for (const Vec3& sample : samples) {
        const Vec3 at = site->frame().of(sample);
        const int a = lowest.lattice.cell_u(at.x()), b = lowest.lattice.cell_v(at.y());
        if (lowest.lattice.contains(a, b) && at.z() > static_cast<double>(lowest.at(a, b))) ++gains[number];
      }
    });
    const auto most = std::ranges::max_element(gains);
    const double share = static_cast<double>(*most) / std::pow(job_.grid.n / stride, 3);
    if (share < least_gain_share) return std::nullopt;
    return static_cast<std::size_t>(most - gains.begin());
  }

  void rough_along(std::size_t number) {
    const Direction& direction = mill_directions()[number];
    held_->field(direction, job_.home, run_);
    const PostureField* field = held_->open_field(direction, cells_of(stock_.standing(), job_.grid, around_), run_);
    if (field == nullptr) return;
    const auto site = make_site(number, rough_share * tool().cutter.radius_m, rough_step_m());
    const ToolFrame& frame = site->frame();
    const double top = highest(site->stands());
    const ReachFloor floor(*field, around_, *site, top + room_around_m);
    const IsReachable reachable = [&floor](const Vec3& at) { return floor.allows(at); };
    std::optional<Vec3> hub;
    for (const double above_m : {room_around_m, room_around_m / 2, 2 * air_clearance_m})
      if (!hub) hub = find_hub(*site, top + above_m, reachable);
    if (!hub || !arm_.hold(*field, static_cast<int>(number), frame.point(*hub))) return;
    trail_.clear();
    const MillSweeps sweeps(tool().cutter, direction, cut_stray_m, job_.grid.voxel_m);
    StockTop surface = surface_of(*site);
    double bottom = top;
    for (int corner = 0; corner < 8; ++corner)
      bottom = std::min(bottom, frame
                                    .of(job_.grid.origin_m + job_.grid.n * job_.grid.voxel_m *
                                                                 Vec3(corner & 1, corner >> 1 & 1, corner >> 2))
                                    .z());
    for (double height = top - tool().max_depth_m; height > bottom - tool().cutter.radius_m;
         height -= tool().max_depth_m)
      rough_level_along(*site, surface, height, *hub, reachable, sweeps);
    draw_back(*site, *hub, sweeps);
  }

  /// What is to be cut and can be: not all that may stand.
  HeightMap tops_to_cut(const Site& site) const {
    return heights_of(stock_.left(), job_.grid, site.frame(), site.lattice(), &site.lowest_cut());
  }
  /// Would the tool, if it came everywhere down to this height, take off enough for a pass?
  bool is_worth_it(const Site& site, const StockTop& surface, double height) const {
    double volume = 0;
    const double cusp = cusp_share * tool().max_depth_m, cell = std::pow(site.lattice().step, 2);
    const std::vector<float>&tops = surface.map().heights, &lowest = site.lowest_cut().heights;
    for (std::size_t at = 0; at < tops.size(); ++at) {
      const double left = std::max(height, static_cast<double>(lowest[at]));
      if (static_cast<double>(tops[at]) > left + cusp) volume += (static_cast<double>(tops[at]) - left) * cell;
    }
    return volume >= least_pass_m3(tool());
  }
  StockTop surface_of(const Site& site) const { return {tops_to_cut(site), tool().cutter, cut_stray_m}; }

  /// Up from where the tip is and over to the hub; where that is not possible, from a place where the tip was before.
  void draw_back(const Site& site, const Vec3& hub, const MillSweeps& sweeps) {
    for (;;) {
      std::vector<MillStroke> strokes;
      hop(site, site.frame().of(*arm_.tip()), hub, hub.z(), strokes);
      const std::vector<Vec3> trail = trail_;
      if (carry_out(strokes, sweeps) == strokes.size()) return;
      trail_ = trail;
      if (trail_.empty()) throw InputError("no_transit", "the arm cannot draw back along the tool's axis");
      const Vec3 before = trail_.back();
      trail_.pop_back();
      const std::vector<Vec3> rest = trail_;
      carry_out({{before, true, cut_stray_m}}, sweeps);
      trail_ = rest;
    }
  }

  void rough_level_along(Site& site, StockTop& surface, double height, const Vec3& hub, const IsReachable& reachable,
                         const MillSweeps& sweeps) {
    surface.lower_to(tops_to_cut(site));
    if (!is_worth_it(site, surface, height)) return;
    site.see(stock_.standing(), job_.grid);
    std::vector<char> free = free_cells(site, height, reachable);
    double least_height = height;
    for (int failures = 0; failures < max_failures; ++failures) {
      const std::vector<MillStroke> strokes =
          rough_level(site, {tool(), height, cusp_share, free}, least_height, surface, site.frame().of(*arm_.tip()));
      if (strokes.empty()) return;
      const std::size_t done = carry_out(strokes, sweeps);
      if (done == strokes.size()) return;
      // Not there, then, and what was to come after it is planned anew.
      if (!strokes[done].cut) least_height = hub.z();
      const Vec3 refused = site.frame().of(strokes[done].tip_m);
      for_each_cell_near(site.lattice(), refused, refused, tool().cutter.radius_m / 2,
                         [&](int a, int b) { free[site.lattice().index(a, b)] = 0; });
      if (done == 0) draw_back(site, hub, sweeps);
      site.see(stock_.standing(), job_.grid);
      surface = surface_of(site);
    }
  }

  /// Follows strokes as far as that goes; gives how many.
  std::size_t carry_out(const std::vector<MillStroke>& strokes, const MillSweeps& sweeps) {
    FollowedMill followed = arm_.try_strokes(strokes);
    QuantaPoint from = quanta_of(*arm_.tip());
    for (Keyframe& keyframe : followed.keyframes) {
      MillStep& step = *keyframe.mill;
      if (keyframe.cut) removed_ += step.removed = stock_.cut(sweeps, from, step.tip);
      from = step.tip;
    }
    const std::size_t done = followed.strokes;
    trail_.push_back(*arm_.tip());
    for (const Keyframe& keyframe : followed.keyframes) trail_.push_back(point_of(keyframe.mill->tip));
    if (!trail_.empty()) trail_.pop_back();
    arm_.commit(std::move(followed));
    return done;
  }

  static double highest(const HeightMap& map) { return static_cast<double>(*std::ranges::max_element(map.heights)); }

  /// A place above everything that the robot reaches, as near to the middle as there is one.
  std::optional<Vec3> find_hub(const Site& site, double height, const IsReachable& reachable) const {
    const Lattice& lattice = site.lattice();
    const double u = lattice.u(lattice.width / 2), v = lattice.v(lattice.height / 2);
    std::optional<Vec3> nearest;
    double least = 0;
    for (int b = 0; b < lattice.height; b += 4)
      for (int a = 0; a < lattice.width; a += 4) {
        const Vec3 at(lattice.u(a), lattice.v(b), height);
        const double far = std::hypot(at.x() - u, at.y() - v);
        if (nearest && far >= least) continue;
        if (!reachable(at) || site.clear_height(at, at, 0) > height) continue;
        nearest = at;
        least = far;
      }
    return nearest;
  }

  const MillJob& job_;
  const RunContext& run_;
  MillStock stock_;
  std::uint64_t to_remove_, removed_ = 0;
  Mesh fixtures_;
  Grid around_;
  std::unique_ptr<HeldTool> held_;
  std::unique_ptr<ToolMeter> meter_;
  std::optional<Vec3> tip_;  ///< of the last keyframe that was counted
  std::vector<Vec3> trail_;  ///< where it was before, since the direction was entered
  MillArm::Emit emit_;
  MillArm arm_;
};

}  // namespace

const std::vector<Direction>& mill_directions() {
  static const std::vector<Direction> directions = [] {
    std::vector<Direction> all{{0, 0, 1}};
    const auto turned = [](const Direction& d) { return Direction{-d[1], d[0], d[2]}; };
    // Level, level between two sides, leaning over one side and over an edge, and from below the horizon by 30 degrees.
    for (Direction d : {Direction{1, 0, 0}, {1, 1, 0}, {1, 0, 1}, {1, 1, 1}, {26, 0, -15}, {18, 18, -15}})
      for (int quarter = 0; quarter < 4; ++quarter, d = turned(d)) all.push_back(d);
    return all;
  }();
  return directions;
}

MillResult mill(const MillJob& job, const std::function<void(std::vector<Keyframe>)>& emit, const RunContext& run) {
  return Mill(job, emit, run).run();
}

}  // namespace sculpt
