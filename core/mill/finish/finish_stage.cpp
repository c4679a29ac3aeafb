#include "core/mill/finish/finish_stage.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/mill/drive/hop.hpp"
#include "core/mill/finish/contour_strokes.hpp"
#include "core/mill/finish/nail_reach.hpp"
#include "core/mill/finish/pencil.hpp"
#include "core/mill/finish/rows.hpp"

namespace sculpt {
namespace {

/// How often the last ball cutter goes through all directions, each time with rows twice as near.
constexpr int rounds = 3;
/// Of the nails that are asked for: a direction is entered for so many, and with the last ball cutter for fewer.
constexpr double worth_share = 2e-3, last_worth_share = 3e-4;
/// Rows that do less for their length are not laid: `RowTask::least_worth`.
constexpr double least_worth = 0.4;
/// From place to place where no rows are (row spacings).
constexpr double link_spacings = 5;
/// From row to row along the surface, where that is no farther (row spacings).
constexpr double beside_spacings = 60;
/// Rows whose ends are no farther apart go on as one.
constexpr double joined_m = 1e-9;
constexpr std::size_t strokes_a_batch = 100, looked_at = 6;
constexpr int max_refused = 100;

class FinishStage {
 public:
  FinishStage(const MillJob& job, PartViews& views, Carver& carver, bool is_last, const RunContext& run)
      : job_(job),
        views_(views),
        carver_(carver),
        run_(run),
        nails_(carver.nails()),
        radius_m_(carver.tool().cutter.radius_m),
        spacing_m_(job.wishes.stepover_m(radius_m_)),
        is_last_(is_last),
        reach_(job, views, carver, is_last, run) {}

  void run() {
    reach_.find();
    if (is_last_) reach_.find_beside();
    for (int round = 0; round < (is_last_ ? rounds : 1); ++round) go_through(round);
  }

 private:
  /// All directions, the one that serves most first.
  void go_through(int round) {
    std::vector<std::uint32_t> tried(nails_.size());
    const double worth = (is_last_ ? last_worth_share : worth_share) * static_cast<double>(reach_.asked());
    while (const auto best = best_direction(tried, worth)) machine(*best, round, tried);
  }

  bool is_wanted(std::size_t nail, std::size_t direction, const std::vector<std::uint32_t>& tried) const {
    return reach_.comes_along(nail, direction) && (tried[nail] >> direction & 1) == 0 && reach_.is_open(nail);
  }

  std::optional<std::size_t> best_direction(const std::vector<std::uint32_t>& tried, double worth) const {
    std::vector<std::size_t> counts(reach_.directions());
    run_.helpers.for_each_index(counts.size(), [&](std::size_t direction) {
      for (std::size_t nail = 0; nail < nails_.size(); ++nail) counts[direction] += is_wanted(nail, direction, tried);
    });
    const auto most = std::ranges::max_element(counts);
    if (*most == 0 || static_cast<double>(*most) < worth) return std::nullopt;
    return static_cast<std::size_t>(most - counts.begin());
  }

  void machine(std::size_t direction, int round, std::vector<std::uint32_t>& tried) {
    Site& along = reach_.site(direction);
    const std::vector<std::uint32_t> wanted = enter(direction, along, tried);
    if (wanted.empty()) return;
    const auto columns = views_.along(direction, along.frame());
    const EnvelopeTask task = make_task(along, *columns);
    std::vector<RestingBall> balls;
    for (const std::uint32_t nail : wanted)
      if (!reach_.is_beside(nail)) balls.push_back({nail, reach_.middle_over(nail, along.frame())});
    const RowTask rows{spacing_m_, round, radius_m_, reach_.area_m2(), least_worth};
    follow_rows(along, task, find_rows(rows, along.frame(), nails_, balls));
    // In creases, and where no rows are worth it.
    std::vector<Vec3> places;
    for (const std::uint32_t nail : wanted)
      if (reach_.is_open(nail)) places.push_back(reach_.middle_over(nail, along.frame()));
    follow_rows(along, task, pencil_rows(places, link_spacings * spacing_m_, spacing_m_));
    carver_.draw_back(along);
  }

  /// Holds the tool so that the robot comes to as many wanted nails as it can; gives those, none where it was not
  /// entered. Nobody is tried again but those that it may come to in another way.
  std::vector<std::uint32_t> enter(std::size_t direction, Site& along, std::vector<std::uint32_t>& tried) {
    std::vector<std::uint32_t> wanted;
    for (std::uint32_t nail = 0; nail < nails_.size(); ++nail)
      if (is_wanted(nail, direction, tried)) {
        wanted.push_back(nail);
        tried[nail] |= std::uint32_t{1} << direction;
      }
    along.see(carver_.standing(), job_.grid, run_.helpers);
    const auto tip_at = [&](std::uint32_t nail) { return reach_.tip_at(nail, along.frame()); };
    std::erase_if(wanted, [&](std::uint32_t nail) { return !is_above_floor(along, tip_at(nail)); });
    std::vector<Vec3> tips;
    tips.reserve(wanted.size());
    for (const std::uint32_t nail : wanted) tips.push_back(along.frame().point(tip_at(nail)));
    if (!carver_.enter(direction, along, tips)) return {};
    std::erase_if(wanted, [&](std::uint32_t nail) {
      const bool comes = carver_.reach().allows(tip_at(nail));
      if (!comes) tried[nail] &= ~(std::uint32_t{1} << direction);
      return !comes;
    });
    return wanted;
  }

  void follow_rows(const Site& site, const EnvelopeTask& task, const std::vector<Row>& rows) {
    std::vector<std::vector<Contour>> found(rows.size());
    run_.helpers.for_each_index(rows.size(), [&](std::size_t row) {
      if (run_.watch.stop.stop_requested()) throw Cancelled{};
      found[row] = follow_envelope(task, rows[row].from, rows[row].to, rows[row].stops);
    });
    std::vector<Contour> contours;
    for (auto& each : found)
      for (Contour& contour : each)
        if (!contours.empty() && (contours.back().back() - contour.front()).norm() < joined_m)
          contours.back().insert(contours.back().end(), contour.begin() + 1, contour.end());
        else
          contours.push_back(std::move(contour));
    carry_out(site, task, std::move(contours));
    carver_.settle();
  }

  EnvelopeTask make_task(const Site& site, const FacetColumns& columns) const {
    EnvelopeTask task{columns, radius_m_, job_.wishes.allowance_m, 0, job_.wishes.chord_m(), 0, {}};
    task.clear_m = job_.wishes.stray_m() + (job_.wishes.allowance_m - job_.wishes.stray_m()) / 8;
    task.bottom_m = carver_.bottom(site.frame());
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

  /// A contour of a batch, and which of its strokes was the first one for it.
  struct Laid {
    Contour contour;
    std::size_t begin;
  };
  struct Batch {
    std::vector<MillStroke> strokes;
    std::vector<Laid> contours;  ///< in the order of their strokes
    std::vector<Contour> apart;  ///< that the robot does not come to from above
  };

  /// Does the robot hold the tip above where a contour begins, as high as it comes over?
  bool comes_over(const Site& site, const Contour& contour, double min_height) const {
    Vec3 over = contour.front();
    over.z() = std::max(site.clear_height(over, over, air_clearance_m), min_height);
    return carver_.reach().allows(over);
  }

  /// The nearest that the tip comes to along the surface; else the nearest that it may come to from above.
  void lay_next(const Site& site, double min_height, std::vector<Contour>& contours, ContourStrokes& laid,
                Batch& batch) const {
    const std::vector<std::size_t> near = turn_nearest(laid.at(), contours, looked_at);
    std::size_t next = near.front();
    Contour way;
    for (std::size_t at = 0; at < near.size() && way.empty() && laid.is_down(); ++at) {
      way = laid.way_to(contours[near[at]]);
      if (!way.empty()) next = near[at];
    }
    bool comes = !way.empty();
    for (std::size_t at = 0; at < near.size() && !comes; ++at)
      if ((comes = comes_over(site, contours[near[at]], min_height))) next = near[at];
    Contour contour = std::move(contours[next]);
    contours.erase(contours.begin() + static_cast<std::ptrdiff_t>(next));
    if (!comes) return batch.apart.push_back(std::move(contour));
    const std::size_t begin = laid.strokes().size();
    laid.lay(contour, way);
    batch.contours.push_back({std::move(contour), begin});
  }

  Batch lay_batch(const Site& site, double min_height, std::vector<Contour>& contours, ContourStrokes& laid) const {
    Batch batch;
    while (!contours.empty() && laid.strokes().size() < strokes_a_batch)
      lay_next(site, min_height, contours, laid, batch);
    batch.strokes = laid.take_strokes();
    return batch;
  }

  /// Ways over as low as they may be; those that the robot cannot go so once more, above everything.
  void carry_out(const Site& site, const EnvelopeTask& task, std::vector<Contour> contours) {
    for (const double min_height : {-std::numeric_limits<double>::infinity(), carver_.hub().z()})
      contours = carry_out(site, task, std::move(contours), min_height);
  }

  struct BatchesDone {
    Batch batch, ahead;    ///< the last one that the arm began with, and the one after it
    std::size_t done = 0;  ///< strokes of the last one
  };

  /// Until all is laid, or the arm does not come to the end of a batch.
  BatchesDone follow_batches(const Site& site, double min_height, std::vector<Contour>& contours, ContourStrokes& laid,
                             std::vector<Contour>& apart) {
    BatchesDone last{{}, lay_batch(site, min_height, contours, laid), 0};
    while (!last.ahead.contours.empty() && last.done == last.batch.strokes.size()) {
      last.batch = std::exchange(last.ahead, {});
      std::ranges::move(last.batch.apart, std::back_inserter(apart));
      // While the arm follows, the next one is laid; it counts on this one.
      run_.helpers.for_each_index(2, [&](std::size_t which) {
        if (which == 0)
          last.done = carver_.carry_out(last.batch.strokes);
        else
          last.ahead = lay_batch(site, min_height, contours, laid);
      });
    }
    return last;
  }

  /// Gives those that it found no way to.
  std::vector<Contour> carry_out(const Site& site, const EnvelopeTask& task, std::vector<Contour> contours,
                                 double min_height) {
    std::vector<Contour> apart;
    for (int failures = 0; !contours.empty() && failures < max_refused; ++failures) {
      ContourStrokes laid({site, task, carver_.tool(), carver_.swept(), job_.grid.voxel_m, job_.wishes.stray_m(),
                           beside_spacings * spacing_m_, min_height},
                          carver_.left(), carver_.tip(site));
      auto [batch, ahead, done] = follow_batches(site, min_height, contours, laid, apart);
      std::ranges::move(ahead.apart, std::back_inserter(apart));
      if (done == batch.strokes.size()) break;
      // What was to come after the one that failed is planned anew.
      const auto failed = std::ranges::upper_bound(batch.contours, done, {}, &Laid::begin) - 1;
      if (!batch.strokes[done].cut) apart.push_back(std::move(failed->contour));
      for (auto next = failed + 1; next != batch.contours.end(); ++next) contours.push_back(std::move(next->contour));
      for (Laid& next : ahead.contours) contours.push_back(std::move(next.contour));
      carver_.draw_back(site);
    }
    return apart;
  }

  const MillJob& job_;
  PartViews& views_;
  Carver& carver_;
  const RunContext& run_;
  const Nails& nails_;
  double radius_m_, spacing_m_;
  bool is_last_;
  NailReach reach_;
};

}  // namespace

void finish(const MillJob& job, PartViews& views, Carver& carver, bool is_last, const RunContext& run) {
  FinishStage(job, views, carver, is_last, run).run();
}

}  // namespace sculpt
