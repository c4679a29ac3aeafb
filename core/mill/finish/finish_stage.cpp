#include "core/mill/finish/finish_stage.hpp"

#include <algorithm>
#include <cmath>

#include "core/mill/drive/hop.hpp"
#include "core/mill/finish/envelope.hpp"
#include "core/mill/finish/rows.hpp"
#include "core/mill/rough/stock_top.hpp"

namespace sculpt {
namespace {

/// Lattices for what is above the cutter: cells of its radius, and no finer than this.
constexpr double cells_a_radius = 8, finest_cell_m = 8e-4;
/// The body keeps that much more off than it may stray.
constexpr double body_room_m = 1e-4;
/// Of the tolerance: a nail counts as reached where the cutter would leave no more, the allowance aside.
constexpr double reached_share = 1.0 / 3;
/// A ball at rest on a nail is looked at a little smaller, so that the nail itself is not in its way.
constexpr double rest_slack_m = 1e-6;
/// Angle classes: the axis is first tried near the normal. Cosines.
constexpr std::array classes{0.64, 0.34, -0.02};
/// How often all directions are gone through, each time with rows twice as near.
constexpr int rounds = 3;
/// Of all nails: a direction is entered for so many, and in the last class for fewer.
constexpr double worth_share = 2e-3, last_worth_share = 3e-4;
/// From row to row along the surface, where that is no farther (row spacings) and not much longer than straight.
constexpr double beside_spacings = 20, detour = 3;
/// Edges below this (m3/m over depth times width) are not cut: more would be taken off than the tool can.
constexpr double most_engaged = 1.0;
/// Of depth x width x radius: what may stand where the cutter is let down.
constexpr double most_plunged = 0.5;
constexpr std::size_t strokes_a_batch = 4000;
constexpr int max_failures = 100;

class FinishStage {
 public:
  FinishStage(const MillJob& job, PartViews& views, Carver& carver, const RunContext& run)
      : job_(job),
        views_(views),
        carver_(carver),
        run_(run),
        nails_(carver.nails()),
        radius_m_(carver.tool().cutter.radius_m),
        spacing_m_(std::sqrt(8 * job.wishes.scallop_m * radius_m_)),
        reach_(nails_.size()) {
    for (const Direction& direction : mill_directions()) frames_.emplace_back(direction);
    sites_.resize(frames_.size());
  }

  void run(bool is_last) {
    for (int round = 0; round < (is_last ? rounds : 1); ++round) {
      std::vector<std::uint32_t> tried(nails_.size());
      for (std::size_t angle = 0; angle < classes.size(); ++angle) {
        if (round == 0) find_reach(angle == 0 ? 2.0 : classes[angle - 1], classes[angle]);
        const bool is_rest = is_last && (round > 0 || angle + 1 == classes.size());
        const double worth = (is_rest ? last_worth_share : worth_share) * static_cast<double>(nails_.size());
        while (const auto best = best_direction(classes[angle], tried, worth))
          machine(*best, classes[angle], round, tried);
      }
    }
  }

 private:
  bool is_open(std::size_t nail) const { return nails_.excess(nail) > job_.wishes.tolerance_m; }
  double cosine(std::size_t nail, std::size_t direction) const { return nails_[nail].normal.dot(frames_[direction].w); }
  double step_m() const { return std::max(finest_cell_m, radius_m_ / cells_a_radius); }
  /// Made when first asked for; of each direction one thread at a time.
  Site& site(std::size_t direction) {
    if (!sites_[direction]) sites_[direction] = make_site(direction);
    return *sites_[direction];
  }
  std::unique_ptr<Site> make_site(std::size_t direction) const {
    return carver_.make_site(direction, {job_.wishes.allowance_m + job_.wishes.stray_m(), body_stray_m + body_room_m},
                             step_m());
  }
  Vec3 middle_over(std::size_t nail, const ToolFrame& frame) const {
    return frame.of(nails_[nail].point + (radius_m_ + job_.wishes.allowance_m) * nails_[nail].normal);
  }

  static bool is_above_floor(const Site& site, const Vec3& tip) {
    const int a = site.lattice().cell_u(tip.x()), b = site.lattice().cell_v(tip.y());
    return site.lattice().contains(a, b) && site.floor(a, b) <= tip.z();
  }

  /// Of all open nails whose normals are that near to a direction: could the cutter come to them along it?
  void find_reach(double below, double from) {
    std::vector<std::vector<char>> found(frames_.size());
    run_.helpers.for_each_index(frames_.size(), [&](std::size_t direction) {
      const Site& here = site(direction);
      const auto columns = views_.along(direction, frames_[direction]);
      found[direction].resize(nails_.size());
      for (std::size_t nail = 0; nail < nails_.size(); ++nail) {
        const double along = cosine(nail, direction);
        if (along < below && along >= from && is_open(nail)) found[direction][nail] = is_reached(nail, here, *columns);
        if (nail % 1024 == 0 && run_.watch.stop.stop_requested()) throw Cancelled{};
      }
    });
    for (std::size_t direction = 0; direction < found.size(); ++direction)
      for (std::size_t nail = 0; nail < nails_.size(); ++nail)
        if (found[direction][nail]) {
          reach_[nail] |= std::uint32_t{1} << direction;
          carver_.mark_reachable(nail);
        }
  }

  bool is_reached(std::size_t nail, const Site& site, const FacetColumns& columns) const {
    const Vec3 middle = middle_over(nail, site.frame());
    if (!is_above_floor(site, middle - Vec3(0, 0, radius_m_))) return false;
    const double height = columns.rest_height(
        middle.x(), middle.y(), radius_m_ + job_.wishes.allowance_m - rest_slack_m, middle.z() - rest_slack_m);
    const double left = way_to_ball(site.frame().of(nails_[nail].point), site.frame().of(nails_[nail].normal),
                                    {middle.x(), middle.y(), height}, radius_m_);
    return left <= job_.wishes.allowance_m + reached_share * job_.wishes.tolerance_m;
  }

  bool is_wanted(std::size_t nail, std::size_t direction, double from, const std::vector<std::uint32_t>& tried) const {
    return (reach_[nail] & ~tried[nail]) >> direction & 1 && is_open(nail) && cosine(nail, direction) >= from;
  }

  std::optional<std::size_t> best_direction(double from, const std::vector<std::uint32_t>& tried, double worth) const {
    std::vector<std::size_t> counts(frames_.size());
    for (std::size_t direction = 0; direction < counts.size(); ++direction)
      for (std::size_t nail = 0; nail < nails_.size(); ++nail)
        counts[direction] += is_wanted(nail, direction, from, tried);
    const auto most = std::ranges::max_element(counts);
    if (*most == 0 || static_cast<double>(*most) < worth) return std::nullopt;
    return static_cast<std::size_t>(most - counts.begin());
  }

  void machine(std::size_t direction, double from, int round, std::vector<std::uint32_t>& tried) {
    std::vector<std::uint32_t> wanted;
    for (std::uint32_t nail = 0; nail < nails_.size(); ++nail)
      if (is_wanted(nail, direction, from, tried)) {
        wanted.push_back(nail);
        tried[nail] |= std::uint32_t{1} << direction;
      }
    Site& along = site(direction);
    along.see(carver_.stock().standing(), job_.grid);
    if (!carver_.enter(direction, along)) return;
    const auto columns = views_.along(direction, along.frame());
    std::erase_if(wanted, [&](std::uint32_t nail) {
      const Vec3 tip = middle_over(nail, along.frame()) - Vec3(0, 0, radius_m_);
      return !is_above_floor(along, tip) || !carver_.reach().allows(tip);
    });
    const EnvelopeTask task = make_task(along, *columns);
    const std::vector<Row> rows =
        find_rows({radius_m_ + job_.wishes.allowance_m, spacing_m_, round}, along.frame(), nails_, wanted);
    std::vector<std::vector<Contour>> found(rows.size());
    run_.helpers.for_each_index(rows.size(), [&](std::size_t row) {
      if (run_.watch.stop.stop_requested()) throw Cancelled{};
      found[row] = follow_envelope(task, rows[row].from, rows[row].to);
    });
    std::vector<Contour> contours;
    for (auto& each : found) std::ranges::move(each, std::back_inserter(contours));
    carry_out(along, task, std::move(contours));
    carver_.draw_back(along);
  }

  EnvelopeTask make_task(const Site& site, const FacetColumns& columns) const {
    EnvelopeTask task{columns, radius_m_, job_.wishes.allowance_m, 0, job_.wishes.chord_m(), 0, {}};
    task.clear_m = job_.wishes.stray_m() + (job_.wishes.allowance_m - job_.wishes.stray_m()) / 8;
    const double size = job_.grid.n * job_.grid.voxel_m;
    task.bottom_m = site.top();
    for (int corner = 0; corner < 8; ++corner)
      task.bottom_m =
          std::min(task.bottom_m,
                   site.frame().of(job_.grid.origin_m + size * Vec3(corner & 1, corner >> 1 & 1, corner >> 2)).z());
    task.is_allowed = [this, &site](const Vec3& a, const Vec3& b) {
      if (!carver_.reach().allows(a) || !carver_.reach().allows(b)) return false;
      const double lowest = std::min(a.z(), b.z());
      bool allowed = true;
      for_each_cell_near(site.lattice(), a, b, 0,
                         [&](int i, int j) { allowed = allowed && site.floor(i, j) <= lowest; });
      return allowed && is_above_floor(site, a) && is_above_floor(site, b);
    };
    return task;
  }

  /// The contour that begins or ends nearest to a place, turned so that it begins there.
  static std::size_t take_nearest(const Vec3& at, std::vector<Contour>& contours) {
    double least = std::numeric_limits<double>::infinity();
    std::size_t nearest = 0;
    bool turned = false;
    for (std::size_t number = 0; number < contours.size(); ++number)
      for (const bool back : {false, true}) {
        const double far = ((back ? contours[number].back() : contours[number].front()) - at).squaredNorm();
        if (far >= least) continue;
        least = far;
        nearest = number;
        turned = back;
      }
    if (turned) std::ranges::reverse(contours[nearest]);
    return nearest;
  }

  /// Along the surface to where the next contour begins; nothing where that is no short way.
  Contour connect(const EnvelopeTask& task, const Vec3& from, const Vec3& to) const {
    const double far = (to - from).norm();
    if (far > beside_spacings * spacing_m_) return {};
    std::vector<Contour> ways = follow_envelope(task, from.head<2>(), to.head<2>());
    if (ways.size() != 1) return {};
    Contour& way = ways.front();
    double length = 0;
    for (std::size_t at = 1; at < way.size(); ++at) length += (way[at] - way[at - 1]).norm();
    if (length > detour * far || (way.front() - from).norm() > 1e-6 || (way.back() - to).norm() > 1e-6) return {};
    return way;
  }

  /// A contour of a batch, and which of its strokes was the first one for it.
  struct Laid {
    Contour contour;
    std::size_t begin;
  };

  void carry_out(const Site& site, const EnvelopeTask& task, std::vector<Contour> contours) {
    double least_height = -std::numeric_limits<double>::infinity();
    for (int failures = 0; !contours.empty() && failures < max_failures;) {
      StockTop stock = see_stock(site);
      std::vector<MillStroke> strokes;
      std::vector<Laid> batch;
      Cut cut{carver_.tip(site), false, least_height};
      while (!contours.empty() && strokes.size() < strokes_a_batch) {
        const std::size_t next = take_nearest(cut.at, contours);
        batch.push_back({std::move(contours[next]), strokes.size()});
        contours.erase(contours.begin() + static_cast<std::ptrdiff_t>(next));
        const Contour& contour = batch.back().contour;
        const Contour way = cut.is_down ? connect(task, cut.at, contour.front()) : Contour{};
        cut.is_down = !way.empty();
        if (cut.is_down) add(site, way, stock, cut, strokes);
        add(site, contour, stock, cut, strokes);
      }
      const std::size_t done = carver_.carry_out(strokes);
      if (done == strokes.size()) continue;
      ++failures;
      // What was to come after the one that failed is planned anew; the one itself once more from above.
      auto failed = std::ranges::upper_bound(batch, done, {}, &Laid::begin) - 1;
      const bool again = !strokes[done].cut && least_height < carver_.hub().z();
      least_height = again ? carver_.hub().z() : least_height;
      if (!again) ++failed;
      for (; failed != batch.end(); ++failed) contours.push_back(std::move(failed->contour));
      carver_.draw_back(site);
    }
  }

  /// The top of what is to come off, of the part nothing.
  StockTop see_stock(const Site& site) const {
    VoxelSet wanted = carver_.stock().left();
    wanted -= job_.voxels.keep;
    return {heights_of(wanted, job_.grid, site.frame(), site.lattice()), carver_.tool().cutter, job_.wishes.stray_m()};
  }

  /// Where the tip is while strokes are laid.
  struct Cut {
    Vec3 at;
    bool is_down;         ///< at rest on the part
    double least_height;  ///< of ways over
  };

  /// Strokes along a contour, let down to it where the cutter is not down; left out is where too much stands.
  void add(const Site& site, const Contour& contour, StockTop& stock, Cut& cut,
           std::vector<MillStroke>& strokes) const {
    const double chip_m2 = carver_.tool().max_depth_m * carver_.tool().max_width_m;
    const auto lower = [&](const Vec3& from, const Vec3& to) { stock.cut(from, to, [](std::size_t, float) {}); };
    for (std::size_t edge = 0; edge + 1 < contour.size(); ++edge) {
      const Vec3 &from = contour[edge], &to = contour[edge + 1];
      if (!cut.is_down) {
        const Vec3 above = from + Vec3(0, 0, radius_m_);
        if (stock.volume(above, from) > most_plunged * chip_m2 * radius_m_) continue;
        hop(site, cut.at, from, std::max(from.z(), cut.least_height), job_.wishes.stray_m(), strokes);
        lower(above, from);
        cut.at = from;
        cut.is_down = true;
      }
      if (stock.volume(from, to) > most_engaged * chip_m2 * std::max((to - from).norm(), radius_m_ / 4)) {
        cut.is_down = false;
        continue;
      }
      lower(from, to);
      strokes.push_back({site.frame().point(to), true, job_.wishes.stray_m()});
      cut.at = to;
    }
  }

  const MillJob& job_;
  PartViews& views_;
  Carver& carver_;
  const RunContext& run_;
  const Nails& nails_;
  double radius_m_, spacing_m_;
  std::vector<ToolFrame> frames_;
  std::vector<std::unique_ptr<Site>> sites_;
  std::vector<std::uint32_t> reach_;  ///< of each nail, a bit for each direction
};

}  // namespace

void finish(const MillJob& job, PartViews& views, Carver& carver, bool is_last, const RunContext& run) {
  FinishStage(job, views, carver, run).run(is_last);
}

}  // namespace sculpt
