#include "core/place/stand_study.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

constexpr std::size_t max_stands = 20000;
constexpr double blocks_around = 1.5, blocks_up = 1;  // edges of the block
constexpr double per_unit = 1e6;  // values are whole multiples of a micrometre or microradian: they read well
constexpr int places_x = 11, places_y = 9, places_up = 5;

/// Metres; a turn of 1 rad counts as 1 m.
double way_between(const Stand& a, const Stand& b) {
  return (a.at_m - b.at_m).norm() + std::abs(a.turn_rad - b.turn_rad) + std::abs(a.height_m - b.height_m) +
         std::abs(a.stickout_m - b.stickout_m);
}

std::uint64_t all_along(const Share& share) {
  return std::accumulate(share.held_along.begin(), share.held_along.end(), std::uint64_t{0});
}

}  // namespace

std::vector<double> StandRange::values() const {
  std::vector<double> values;
  for (int at = 0; at < steps; ++at) {
    const double value = steps == 1 ? from : from + (to - from) * at / (steps - 1);
    values.push_back(at == 0 || at + 1 == steps ? value : std::round(value * per_unit) / per_unit);
  }
  return values;
}

StandRanges ranges_around(const Cell& cell, int joint) {
  const Stand own = stand_of(cell, joint);
  const double around_m = blocks_around * cell.stock_size_m, up_m = blocks_up * cell.stock_size_m;
  const auto range = [](double middle, double half, int steps) {
    const auto whole = [](double value) { return std::round(value * per_unit) / per_unit; };
    return StandRange{whole(middle - half), whole(middle + half), steps};
  };
  return {range(own.at_m.x(), around_m, places_x), range(own.at_m.y(), around_m, places_y),
          range(own.at_m.z(), up_m, places_up),    {0, 0, 1},
          {own.height_m, own.height_m, 1},         {own.stickout_m, own.stickout_m, 1}};
}

std::vector<Stand> list_stands(const StandRanges& ranges, const Stand& own) {
  double count = 1;
  for (const StandRange* range : {&ranges.x, &ranges.y, &ranges.z, &ranges.turn, &ranges.height, &ranges.stickout})
    count *= range->steps;
  if (count > static_cast<double>(max_stands))
    throw InputError("cell_invalid", "the ranges make " + std::to_string(static_cast<std::uint64_t>(count)) +
                                         " stands, more than " + std::to_string(max_stands) + ": ask for fewer steps");
  std::vector<Stand> stands;
  for (const double stickout : ranges.stickout.values())
    for (const double height : ranges.height.values())
      for (const double turn : ranges.turn.values())
        for (const double z : ranges.z.values())
          for (const double y : ranges.y.values())
            for (const double x : ranges.x.values()) stands.push_back({{x, y, z}, turn, height, stickout});
  const auto at = std::ranges::find_if(stands, [&](const Stand& stand) { return way_between(stand, own) < 1e-9; });
  if (at == stands.end())
    stands.push_back(own);
  else
    *at = own;
  return stands;
}

std::vector<RatedStand> rate_stands(const ReachStudy& study, const Demand& demand, const std::vector<Stand>& stands,
                                    const Stand& own, const RunContext& run) {
  std::vector<RatedStand> rated(stands.size());
  std::mutex telling;
  std::uint64_t done = 0;
  run.helpers.for_each_index(stands.size(), [&](std::size_t at) {
    if (run.watch.stop.stop_requested()) throw Cancelled{};
    rated[at] = {stands[at], study.find(stands[at]), {}};
    rated[at].share = find_share(demand, {&rated[at].reach});
    const std::lock_guard lock(telling);
    run.watch.step(Stage::plan, ++done, stands.size());
  });
  const auto worth = [&](const RatedStand& one) {
    return std::tuple(one.share.held, all_along(one.share), -way_between(one.stand, own));
  };
  std::ranges::stable_sort(rated, [&](const RatedStand& a, const RatedStand& b) { return worth(a) > worth(b); });
  return rated;
}

}  // namespace sculpt
