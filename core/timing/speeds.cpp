#include "core/timing/speeds.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/square.hpp"
#include "core/timing/blend_interval.hpp"

namespace sculpt {
namespace {

constexpr double steep =
    1.25;  // ratio of speeds over an interval from which on a constant bounds better than a tangent
constexpr double min_x = 1e-18;

float down(double value) {
  auto rounded = static_cast<float>(value);
  if (static_cast<double>(rounded) > value) rounded = std::nextafter(rounded, 0.0f);
  return rounded;
}

/// x at both ends of a part of a parabola so that, linear in between, it stays below 1 / (linear)^2, which is convex:
/// below its tangent in the middle, or below the smaller of its ends.
std::pair<double, double> caps_over(double slowness, double slowness_after) {
  const double low = std::min(slowness, slowness_after), high = std::max(slowness, slowness_after);
  if (high > steep * low) return {1 / square(high), 1 / square(high)};
  const double middle = (slowness + slowness_after) / 2, value = 1 / square(middle),
               half_change = value * (slowness_after - slowness) / middle;
  return {value + half_change, value - half_change};
}

struct EdgeWay {
  Configuration way;  // q' over the joints' accelerations
  double length, acceleration;
};

class SpeedFinder {
 public:
  SpeedFinder(const PlanPath& path, const CornerDemands& demands, Corners& corners)
      : path_(path), demands_(demands), corners_(corners) {
    const auto dof = static_cast<std::size_t>(path.dof());
    account_.velocity.assign(dof, 0);
    account_.acceleration.assign(dof, 0);
    account_.jerk.assign(dof, 0);
    if (path.header().mill) account_.tools.assign(path.header().mill->tools.size(), 0);
  }

  TimeAccount run() {
    if (path_.size() > 1) {
      go_back();
      go_on();
    }
    account_.total += demands_.window_s;
    return std::move(account_);
  }

 private:
  EdgeWay edge_to(std::size_t point) const {
    EdgeWay edge;
    const auto dof = static_cast<Eigen::Index>(path_.dof());
    edge.way = (Eigen::Map<const Configuration>(path_.point(point), dof) -
                Eigen::Map<const Configuration>(path_.point(point - 1), dof))
                   .cwiseQuotient(demands_.acceleration);
    edge.length = edge.way.norm();
    edge.way /= edge.length;
    edge.acceleration = 1 / edge.way.cwiseAbs().maxCoeff();
    return edge;
  }

  double line_of(std::size_t point, double length) const {
    return length - static_cast<double>(corners_.law[point - 1].half) - static_cast<double>(corners_.law[point].half);
  }

  struct Parts {
    BlendInterval first, second;
  };
  static Parts parts_of(const LawCorner& corner, const EdgeWay& before, const EdgeWay& after) {
    const double half = static_cast<double>(corner.half), most = std::max(before.acceleration, after.acceleration);
    const Configuration bend = (after.way - before.way) / (2 * half);
    return {{before.way, bend, half, most}, {(before.way + after.way) / 2, bend, half, most}};
  }

  struct NodeCaps {
    double in, mid, out;
  };
  NodeCaps caps_of(std::size_t point) const {
    const LawCorner& corner = corners_.law[point];
    const CornerCaps& caps = corners_.caps[point];
    const double before = 1 / static_cast<double>(caps.before), after = 1 / static_cast<double>(caps.after),
                 most = square(static_cast<double>(caps.cap));
    const auto [in, first_mid] = caps_over(before, (before + after) / 2);
    const auto [second_mid, out] = caps_over((before + after) / 2, after);
    return {std::min({in, most, square(static_cast<double>(corner.cruise))}), std::min({first_mid, second_mid, most}),
            std::min({out, most, square(static_cast<double>(corners_.law[point + 1].cruise))})};
  }

  void go_back() {
    const std::size_t last = path_.size() - 1;
    corners_.law[last].x_in = 0;
    EdgeWay after = edge_to(last);
    for (std::size_t point = last; point-- > 0;) {
      demands_.go_on_from(point);
      LawCorner& corner = corners_.law[point];
      const LawCorner& next = corners_.law[point + 1];
      const double reach = static_cast<double>(next.x_in) + 2 * after.acceleration * line_of(point + 1, after.length),
                   cruise = square(static_cast<double>(next.cruise));
      if (point == 0) break;  // home: at rest
      const EdgeWay before = edge_to(point);
      if (corner.half > 0) {
        const NodeCaps caps = caps_of(point);
        const Parts parts = parts_of(corner, before, after);
        corner.x_out = down(std::min({reach, cruise, caps.out}));
        corner.x_mid = down(parts.second.max_start(caps.mid, static_cast<double>(corner.x_out)));
        corner.x_in = down(parts.first.max_start(caps.in, static_cast<double>(corner.x_mid)));
      } else if (corners_.caps[point].straight) {
        corner.x_in = corner.x_mid = corner.x_out =
            down(std::min({reach, cruise, square(static_cast<double>(corner.cruise)),
                           square(static_cast<double>(corners_.caps[point].cap))}));
      }
      after = before;
    }
  }

  void go_on() {
    EdgeWay before = edge_to(1), after = before;
    for (std::size_t point = 1; point < path_.size(); ++point, before = after) {
      demands_.go_on_from(point);
      LawCorner& corner = corners_.law[point];
      const double x = static_cast<double>(corners_.law[point - 1].x_out), length = line_of(point, before.length);
      corner.x_in = down(std::min(static_cast<double>(corner.x_in), x + 2 * before.acceleration * length));
      tool_ = path_.edge_to(point).tool;
      take_line(point, before, length);
      if (point + 1 == path_.size()) break;
      after = edge_to(point + 1);
      if (corner.half > 0) {
        go_through(point, before, parts_of(corner, before, after));
      } else if (corners_.caps[point].straight) {
        corner.x_mid = corner.x_out = corner.x_in;
      } else {
        take(demands_.window_s, rests_for(before, after));
      }
    }
  }

  void go_through(std::size_t point, const EdgeWay& before, const Parts& parts) {
    LawCorner& corner = corners_.law[point];
    const NodeCaps caps = caps_of(point);
    const double half = static_cast<double>(corner.half);
    const auto step = [&](const BlendInterval& part, float from, float& to, double cap) {
      const double start = static_cast<double>(from), most = static_cast<double>(to);
      to = std::max(down(part.max_end(start, most)), static_cast<float>(min_x));
      const double end = static_cast<double>(to), time = 2 * half / (std::sqrt(start) + std::sqrt(end));
      account_.at_caps += half / std::sqrt(std::max(cap, min_x));
      // Held down by what is possible behind it, or by what is here?
      const bool capped = end >= 0.999 * cap;
      take(time, capped ? cause_of_cap(point, before) : static_cast<std::size_t>(std::max(0, part.binding(start))));
    };
    step(parts.first, corner.x_in, corner.x_mid, caps.mid);
    step(parts.second, corner.x_mid, corner.x_out, caps.out);
  }

  /// From x_out before it to x_in at the point, up to cruise in between.
  void take_line(std::size_t point, const EdgeWay& edge, double length) {
    const LawCorner& corner = corners_.law[point];
    const double cruise = static_cast<double>(corner.cruise);
    const double from = std::sqrt(static_cast<double>(corners_.law[point - 1].x_out)),
                 to = std::sqrt(static_cast<double>(corner.x_in)), a = edge.acceleration;
    const double peak = std::min(cruise, std::sqrt((from * from + to * to) / 2 + a * length));
    const double at_cruise = std::max(0.0, length - (2 * peak * peak - from * from - to * to) / (2 * a));
    account_.at_caps += length / cruise;
    Eigen::Index joint = 0;
    edge.way.cwiseAbs().maxCoeff(&joint);
    take((2 * peak - from - to) / a, static_cast<std::size_t>(joint));
    if (peak >= cruise) take(at_cruise / cruise, cause_of_cap(point, edge));
  }

  static constexpr std::size_t by_feed = 1000, by_rapid = 1001, by_velocity = 2000;

  std::size_t rests_for(const EdgeWay& before, const EdgeWay& after) const {
    Eigen::Index joint = 0;
    (after.way - before.way).cwiseAbs().maxCoeff(&joint);
    return static_cast<std::size_t>(joint);
  }

  std::size_t cause_of_cap(std::size_t point, const EdgeWay& edge) const {
    Eigen::Index joint = 0;
    const double rate = edge.way.cwiseAbs().cwiseProduct(acceleration_by_velocity_).maxCoeff(&joint);
    if (rate * static_cast<double>(corners_.law[point].cruise) > 0.999)
      return by_velocity + static_cast<std::size_t>(joint);
    return path_.edge_to(point).cut ? by_feed : by_rapid;
  }

  void take(double seconds, std::size_t cause) {
    account_.total += seconds;
    if (!account_.tools.empty()) account_.tools[tool_] += seconds;
    if (cause == by_feed) {
      account_.feed += seconds;
    } else if (cause == by_rapid) {
      account_.rapid += seconds;
    } else if (cause >= by_velocity) {
      account_.velocity[cause - by_velocity] += seconds;
    } else {
      const auto joint = static_cast<Eigen::Index>(cause);
      const bool jerks = demands_.acceleration[joint] < 0.99 * demands_.limits.acceleration[joint];
      (jerks ? account_.jerk : account_.acceleration)[cause] += seconds;
    }
  }

  const PlanPath& path_;
  const CornerDemands& demands_;
  Corners& corners_;
  const Configuration acceleration_by_velocity_ = demands_.acceleration.cwiseQuotient(demands_.limits.velocity);
  TimeAccount account_;
  std::size_t tool_ = 0;
};

}  // namespace

TimeAccount find_speeds(const PlanPath& path, const CornerDemands& demands, Corners& corners) {
  return SpeedFinder(path, demands, corners).run();
}

}  // namespace sculpt
