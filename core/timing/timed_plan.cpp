#include "core/timing/timed_plan.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/base/error.hpp"
#include "core/timing/corners.hpp"
#include "core/timing/path_tool.hpp"
#include "core/timing/slow_places.hpp"
#include "core/timing/speeds.hpp"

namespace sculpt {
namespace {

// For numbers of 32 bits and double arithmetic.
constexpr double share_of_acceleration = 1 - 5e-4, share_of_speed = 1 - 1e-6;
constexpr double min_ladder_s = 0.008;  // a window no longer than that is taken as it is
constexpr int usual_step = 4;           // a quarter of the longest

struct Attempt {
  Configuration acceleration;
  double window_s;
  Corners corners;
  TimeAccount time;
};

struct TimerInputs {
  const PlanPath& path;
  const PathTools& tools;
  const MotionLimits& limits;
  const MotionDemands& demands;
  const std::stop_token& stop;
};

class Timer {
 public:
  explicit Timer(const TimerInputs& asked) : asked_(asked) {}

  /// The mean over a window T of a motion with |q''| <= a has |q'''| <= 2 a / T.
  Attempt with_window(double window_s) const {
    Attempt attempt{share_of_acceleration * asked_.limits.acceleration.cwiseMin(asked_.limits.jerk * (window_s / 2)),
                    window_s,
                    {},
                    {}};
    MotionLimits slower = asked_.limits;
    slower.velocity *= share_of_speed;
    const CornerDemands wanted{slower,
                               attempt.acceleration,
                               window_s,
                               {share_of_speed * asked_.demands.feed_m_s, share_of_speed * asked_.demands.rapid_m_s},
                               asked_.stop};
    attempt.corners = find_corners(asked_.path, asked_.tools, wanted);
    attempt.time = find_speeds(asked_.path, wanted, attempt.corners);
    return attempt;
  }

  /// A long window strays far and so slows down corners, a short one asks for less acceleration: somewhere between the
  /// time is least. Of windows that are each sqrt(2) times shorter than the one before it is looked for from the one
  /// that leaves a quarter of the acceleration, the longest being needed for all of it.
  Attempt best() const {
    const double longest_s = 2 * asked_.limits.acceleration.cwiseQuotient(asked_.limits.jerk).maxCoeff();
    const auto window_at = [&](int step) { return longest_s / std::pow(2, step / 2.0); };
    int last = 0;
    while (window_at(last) > min_ladder_s) ++last;
    int step = std::min(usual_step, last);
    Attempt best = with_window(window_at(step));
    for (const int way : {1, -1}) {
      const int begin = step;
      while (step + way >= 0 && step + way <= last) {
        Attempt next = with_window(window_at(step + way));
        if (next.time.total >= best.time.total) break;
        best = std::move(next);
        step += way;
      }
      if (step != begin) break;
    }
    return best;
  }

 private:
  const TimerInputs& asked_;
};

TimeLaw law_of(const PlanPath& path, Attempt&& attempt, const MotionDemands& demands) {
  TimeLaw law;
  law.acceleration.assign(attempt.acceleration.begin(), attempt.acceleration.end());
  law.window_s = attempt.window_s;
  law.feed_m_s = demands.feed_m_s;
  law.rapid_m_s = demands.rapid_m_s;
  attempt.corners.caps = {};
  law.corners = std::move(attempt.corners.law);
  law.corners.resize(path.keyframes() + 1);
  for (std::size_t point = path.size(); point-- > 1;) {  // from points to keyframes, in place
    const LawCorner corner = law.corners[point];
    law.corners[point] = {};
    law.corners[path.edge_to(point).keyframe] = corner;
  }
  law.corners.erase(law.corners.begin());
  return law;
}

}  // namespace

void check_cell(const PlanPath& path, const Chain& chain, const Cell& cell) {
  const Grid grid = cell.grid(path.header().grid.n);
  if (path.header().joints != chain.names() || std::abs(path.header().grid.voxel_m - grid.voxel_m) > 1e-12 ||
      (path.header().grid.origin_m - grid.origin_m).norm() > 1e-12)
    throw InputError("cell_mismatch", "the plan was made for cell '" + path.header().cell +
                                          "' with other joints or another stock: name that cell with --robot");
}

TimedPlan time_plan(const PlanPath& path, const Cell& cell, const MotionDemands& demands, const std::stop_token& stop) {
  check_demands(demands);
  const Chain chain = cell.chain();
  check_cell(path, chain, cell);
  const MotionLimits limits = limits_of(cell, chain);
  const PathTools tools(path, cell, demands.reserve_m);
  const TimerInputs asked{path, tools, limits, demands, stop};
  Attempt attempt = Timer(asked).best();
  if (!std::isfinite(attempt.time.total)) {
    std::ostringstream text;
    text << "at a feed of " << demands.feed_m_s << " m/s and a rapid rate of " << demands.rapid_m_s
         << " m/s some edge never ends, as far as the law's file can tell: give 1e-6 m/s or more of both";
    throw InputError("feed_invalid", text.str());
  }
  TimedPlan plan{{}, std::move(attempt.time), {}};
  plan.law = law_of(path, std::move(attempt), demands);
  plan.worst = find_slow_places(path, tools, limits.velocity, plan.law, demands);
  return plan;
}

}  // namespace sculpt
