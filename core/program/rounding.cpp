#include "core/program/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace sculpt {
namespace {

/// Of ball and of shank's end.
using Beside = Eigen::Matrix<double, 6, 1>;

double step_of(const AxisLayout& layout, Eigen::Index axis, int decimals) {
  return (layout.axes[static_cast<std::size_t>(axis)].turns ? std::numbers::pi / 180 : 1e-3) / std::pow(10, decimals);
}

double size_of(const Beside& beside) {
  return std::max(beside.head<3>().norm(), beside.tail<3>().norm());
}

/// Steps of the axes from the nearest numbers, one or two axes at a time as long as that brings the tool nearer.
class Descent {
 public:
  Descent(std::vector<Beside> by_step, const Beside& beside)
      : by_step_(std::move(by_step)), steps_(by_step_.size(), 0), beside_(beside) {
    for (std::size_t first = 0; first < steps_.size(); ++first)
      for (const int by_first : {-1, 1}) {
        changes_.push_back({first, first, by_first, 0});
        for (std::size_t second = first + 1; second < steps_.size(); ++second)
          for (const int by_second : {-1, 1}) changes_.push_back({first, second, by_first, by_second});
      }
  }

  std::vector<int> run() {
    while (take_best()) {
    }
    return std::move(steps_);
  }

 private:
  struct Change {
    std::size_t first = 0, second = 0;
    int by_first = 0, by_second = 0;
  };

  bool take_best() {
    const Change* best = nullptr;
    double least = size_of(beside_) * (1 - 1e-9);
    for (const Change& change : changes_) {
      if (!is_near(change)) continue;
      if (const double size = size_of(after(change)); size < least) {
        least = size;
        best = &change;
      }
    }
    if (best == nullptr) return false;
    beside_ = after(*best);
    steps_[best->first] += best->by_first;
    steps_[best->second] += best->by_second;
    return true;
  }

  bool is_near(const Change& change) const {
    return std::abs(steps_[change.first] + change.by_first) <= 1 &&
           std::abs(steps_[change.second] + change.by_second) <= 1;
  }

  Beside after(const Change& change) const {
    return beside_ + change.by_first * by_step_[change.first] + change.by_second * by_step_[change.second];
  }

  std::vector<Beside> by_step_;
  std::vector<int> steps_;
  Beside beside_;
  std::vector<Change> changes_;
};

}  // namespace

Configuration nearest_axes(const AxisLayout& layout, Configuration axes, int decimals) {
  for (Eigen::Index axis = 0; axis < axes.size(); ++axis) {
    const double step = step_of(layout, axis, decimals);
    axes[axis] = std::round(axes[axis] / step) * step;
  }
  return axes;
}

Configuration round_axes(const AxisLayout& layout, const ToolRates& rates, const Configuration& q, int decimals) {
  ToolPlace tool;
  tool.put(rates, q);
  const auto beside = [&](const Configuration& axes) {
    const Configuration off = layout.to_joints(axes) - q;
    const ToolMotion motion = tool.motion(off, rates.stickout_m);
    Beside both;
    both << motion.ball, motion.top;
    return both;
  };
  const Configuration first = nearest_axes(layout, layout.to_axes(q), decimals);
  const Beside nearest = beside(first);
  std::vector<Beside> by_step;
  for (Eigen::Index axis = 0; axis < first.size(); ++axis) {
    Configuration more = first;
    more[axis] += step_of(layout, axis, decimals);
    by_step.push_back(beside(more) - nearest);
  }
  const std::vector<int> steps = Descent(std::move(by_step), nearest).run();
  Configuration axes = first;
  for (Eigen::Index axis = 0; axis < axes.size(); ++axis)
    axes[axis] += steps[static_cast<std::size_t>(axis)] * step_of(layout, axis, decimals);
  return rates.chain.within_limits(layout.to_joints(axes)) ? axes : first;
}

}  // namespace sculpt
