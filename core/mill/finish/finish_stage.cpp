#include "core/mill/finish/finish_stage.hpp"

#include <algorithm>
#include <optional>

#include "core/mill/finish/contour_runner.hpp"
#include "core/mill/finish/direction_contours.hpp"
#include "core/mill/finish/nail_reach.hpp"

namespace sculpt {
namespace {

/// How often the last ball cutter goes through all directions.
constexpr int rounds = 3;
/// Of the nails that are asked for: a direction is entered for so many, and with the last ball cutter for fewer.
constexpr double worth_share = 2e-3, last_worth_share = 3e-4;
/// Surface that leans more from a direction is finished along another one, where there is one (cosine); and that must
/// be better by so much.
constexpr double facing_cosine = 0.4, better_cosine = 0.1;
/// `CutPreview::cut`. What a large tool leaves is for the next ones; but along directions from below
/// these come to less, for they are shorter.
constexpr double least_worth = 0.12, last_least_worth = 0.05;

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
    while (const auto best = best_direction(round, tried, worth)) machine(*best, round, tried);
  }

  bool is_wanted(std::size_t nail, std::size_t direction, int round, const std::vector<std::uint32_t>& tried) const {
    return may_be_tried(nail, direction, tried) && reach_.is_open(nail) && (round > 0 || faces(nail, direction, tried));
  }
  bool may_be_tried(std::size_t nail, std::size_t direction, const std::vector<std::uint32_t>& tried) const {
    return reach_.comes_along(nail, direction) && (tried[nail] >> direction & 1) == 0;
  }
  /// Or is there no direction left that it faces more?
  bool faces(std::size_t nail, std::size_t direction, const std::vector<std::uint32_t>& tried) const {
    const double cosine = reach_.cosine(nail, direction);
    if (cosine >= facing_cosine) return true;
    for (std::size_t other = 0; other < reach_.directions(); ++other)
      if (reach_.cosine(nail, other) > cosine + better_cosine && may_be_tried(nail, other, tried)) return false;
    return true;
  }

  std::optional<std::size_t> best_direction(int round, const std::vector<std::uint32_t>& tried, double worth) const {
    std::vector<std::size_t> counts(reach_.directions());
    run_.helpers.for_each_index(counts.size(), [&](std::size_t direction) {
      for (std::size_t nail = 0; nail < nails_.size(); ++nail)
        counts[direction] += is_wanted(nail, direction, round, tried);
    });
    const auto most = std::ranges::max_element(counts);
    if (*most == 0 || static_cast<double>(*most) < worth) return std::nullopt;
    return static_cast<std::size_t>(most - counts.begin());
  }

  void machine(std::size_t direction, int round, std::vector<std::uint32_t>& tried) {
    Site& along = reach_.site(direction);
    const std::vector<std::uint32_t> wanted = enter(direction, round, along, tried);
    if (wanted.empty()) return;
    const auto columns = views_.along(direction, along.frame());
    const EnvelopeTask task = make_task(along, *columns);
    DirectionContours contours(
        {direction, along, task, spacing_m_, job_.wishes.stray_m(), least_worth_along(along.frame()), round, is_last_},
        reach_, carver_, run_);
    ContourRunner(job_, carver_, run_, along, task, spacing_m_).run(contours.run(wanted));
    if (!is_last_)
      for (const std::uint32_t nail : contours.left()) tried[nail] = ~std::uint32_t{0};
  }

  double least_worth_along(const ToolFrame& frame) const {
    return is_last_ || frame.direction[2] < 0 ? last_least_worth : least_worth;
  }

  /// Holds the tool so that the robot comes to as many wanted nails as it can; gives those, none where it was not
  /// entered. Nobody is tried again but those that it may come to in another way.
  std::vector<std::uint32_t> enter(std::size_t direction, int round, Site& along, std::vector<std::uint32_t>& tried) {
    std::vector<std::uint32_t> wanted;
    for (std::uint32_t nail = 0; nail < nails_.size(); ++nail)
      if (is_wanted(nail, direction, round, tried)) {
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
  NailReach reach_;
};

}  // namespace

void finish(const MillJob& job, PartViews& views, Carver& carver, bool is_last, const RunContext& run) {
  FinishStage(job, views, carver, is_last, run).run();
}

}  // namespace sculpt
