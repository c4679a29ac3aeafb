#include "core/mill/finish/finish_stage.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <optional>
#include <utility>

#include "core/mill/finish/contour_runner.hpp"
#include "core/mill/finish/direction_contours.hpp"
#include "core/mill/finish/nail_reach.hpp"

namespace sculpt {
namespace {

/// How often the last ball cutter goes through all directions: a neck has room when the flutes have been there.
constexpr int times = 4;
/// Of the nails that are asked for: a direction is entered for so many, and with the last ball cutter for fewer.
constexpr double worth_share = 2e-3, last_worth_share = 4e-4;
/// Surface that leans more from a direction is finished along another one, where there is one (cosine); and that must
/// be better by so much.
constexpr double facing_cosine = 0.4, better_cosine = 0.1;
/// `CutPreview::cut`. What a large tool leaves is for the next ones; but along directions from below
/// these come to less, for they are shorter.
constexpr double least_worth = 0.12, last_least_worth = 0.05;
/// `DirectionTask::worth`: so many times as long as its rows would be the path of the next tool is; and so many times
/// as long the last one may go.
constexpr double next_overhead = 1.8, last_worth = 13;
/// Of what stood in the way: down a wall, a row serves only its lower end.
constexpr double again_worth = 100;

class FinishStage {
 public:
  FinishStage(const MillJob& job, PartViews& views, Carver& carver, const MillTool* next, const RunContext& run)
      : job_(job),
        views_(views),
        carver_(carver),
        run_(run),
        nails_(carver.nails()),
        radius_m_(carver.tool().cutter.radius_m),
        spacing_m_(job.wishes.stepover_m(radius_m_)),
        is_last_(next == nullptr),
        worth_(is_last_ ? last_worth : next_overhead * spacing_m_ / job.wishes.stepover_m(next->cutter.radius_m)),
        reach_(job, views, carver, is_last_, run),
        tried_(nails_.size()) {}

  void run() {
    reach_.find();
    if (is_last_) reach_.find_beside();
    for (; time_ < (is_last_ ? times : 1); ++time_) {
      ask_again();
      go_through();
    }
  }

 private:
  /// All directions, the one that serves most first.
  void go_through() {
    const double worth = (is_last_ ? last_worth_share : worth_share) * static_cast<double>(reach_.asked());
    while (const auto best = best_direction(worth)) machine(*best);
  }

  void ask_again() {
    for (const auto& [nail, direction] : again_) tried_[nail] &= ~(std::uint32_t{1} << direction);
    again_.clear();
  }

  /// A bit for each direction that a nail is to be finished along.
  std::uint32_t wanted_along(std::size_t nail) const {
    const std::uint32_t untried = reach_.along(nail) & ~tried_[nail];
    if (untried == 0 || !reach_.is_open(nail)) return 0;
    double most = -1;
    for_each_of(untried, [&](std::size_t direction) { most = std::max(most, reach_.cosine(nail, direction)); });
    std::uint32_t wanted = 0;
    for_each_of(untried, [&](std::size_t direction) {
      const double cosine = reach_.cosine(nail, direction);
      if (cosine >= facing_cosine || cosine + better_cosine >= most) wanted |= std::uint32_t{1} << direction;
    });
    return wanted;
  }
  template <typename Visit>
  static void for_each_of(std::uint32_t directions, const Visit& visit) {
    for (; directions != 0; directions &= directions - 1) visit(static_cast<std::size_t>(std::countr_zero(directions)));
  }

  std::optional<std::size_t> best_direction(double worth) const {
    std::vector<std::size_t> counts(reach_.directions());
    for (std::size_t nail = 0; nail < nails_.size(); ++nail)
      for_each_of(wanted_along(nail), [&](std::size_t direction) { ++counts[direction]; });
    const auto most = std::ranges::max_element(counts);
    if (*most == 0 || static_cast<double>(*most) < worth) return std::nullopt;
    return static_cast<std::size_t>(most - counts.begin());
  }

  void machine(std::size_t direction) {
    Site& along = reach_.site(direction);
    const std::vector<std::uint32_t> wanted = enter(direction, along);
    if (wanted.empty()) return;
    const auto columns = views_.along(direction, along.frame());
    const EnvelopeTask task = make_task(along, *columns);
    const std::vector<std::uint32_t> broken_off = cut(wanted, direction, along, task, true);
    // By now less stands where contours begin; and these are not trimmed.
    if (!broken_off.empty()) along.see(carver_.standing(), job_.grid, run_.helpers);
    const std::vector<std::uint32_t> left = cut(broken_off, direction, along, task, false);
    for (const std::uint32_t nail : wanted) {
      if (!reach_.is_open(nail)) continue;
      if (!is_last_) tried_[nail] = ~std::uint32_t{0};
      if (reach_.cosine(nail, direction) < DirectionContours::wall_cosine || std::ranges::binary_search(left, nail))
        again_.emplace_back(nail, direction);
    }
  }

  /// Gives those of the nails that the tour finishes but that are still open, ascending: the tool would have taken off
  /// too much at once, or the robot did not come.
  std::vector<std::uint32_t> cut(const std::vector<std::uint32_t>& wanted, std::size_t direction, const Site& along,
                                 const EnvelopeTask& task, bool is_trimmed) {
    if (wanted.empty()) return {};
    DirectionContours contours(
        {direction, along, task, spacing_m_, job_.wishes.stray_m(), least_worth_along(along.frame()), time_,
         time_ > 0 ? again_worth : worth_, is_trimmed, is_last_},
        reach_, carver_, run_);
    WorthwhileTour tour = contours.run(wanted);
    ContourRunner(job_, carver_, run_, along, task, spacing_m_).run(std::move(tour.contours));
    std::vector<std::uint32_t> broken_off;
    std::ranges::copy_if(wanted, std::back_inserter(broken_off),
                         [&](std::uint32_t nail) { return reach_.is_open(nail) && tour.finishes[nail] != 0; });
    return broken_off;
  }

  double least_worth_along(const ToolFrame& frame) const {
    return is_last_ || frame.direction[2] < 0 ? last_least_worth : least_worth;
  }

  /// Holds the tool so that the robot comes to as many wanted nails as it can; gives those, none where it was not
  /// entered. Nobody is tried again but those that it may come to in another way.
  std::vector<std::uint32_t> enter(std::size_t direction, Site& along) {
    std::vector<std::uint32_t> wanted;
    for (std::uint32_t nail = 0; nail < nails_.size(); ++nail)
      if (wanted_along(nail) >> direction & 1) {
        wanted.push_back(nail);
        tried_[nail] |= std::uint32_t{1} << direction;
      }
    along.see(carver_.standing(), job_.grid, run_.helpers);
    const auto tip_at = [&](std::uint32_t nail) { return reach_.tip_at(nail, along.frame()); };
    std::erase_if(wanted, [&](std::uint32_t nail) {
      const bool is_blocked = !is_above_floor(along, tip_at(nail));
      if (is_blocked) again_.emplace_back(nail, direction);
      return is_blocked;
    });
    std::vector<Vec3> tips;
    tips.reserve(wanted.size());
    for (const std::uint32_t nail : wanted) tips.push_back(along.frame().point(tip_at(nail)));
    if (!carver_.enter(direction, along, tips)) return {};
    std::erase_if(wanted, [&](std::uint32_t nail) {
      const bool comes = carver_.reach().allows(tip_at(nail));
      if (!comes) tried_[nail] &= ~(std::uint32_t{1} << direction);
      return !comes;
    });
    return wanted;
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

  const MillJob& job_;
  PartViews& views_;
  Carver& carver_;
  const RunContext& run_;
  const Nails& nails_;
  double radius_m_, spacing_m_;
  bool is_last_;
  double worth_;  ///< `DirectionTask`
  NailReach reach_;
  std::vector<std::uint32_t> tried_;  ///< of each nail, a bit for each direction
  /// Nails that something stands in the way of along a direction, and those of walls that were left.
  std::vector<std::pair<std::uint32_t, std::size_t>> again_;
  int time_ = 0;
};

}  // namespace

void finish(const MillJob& job, PartViews& views, Carver& carver, const MillTool* next, const RunContext& run) {
  FinishStage(job, views, carver, next, run).run();
}

}  // namespace sculpt
