#include "core/timing/blend_interval.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sculpt {
namespace {

constexpr double min_alpha = 1e-12;
constexpr double rounding = 1e-12;
constexpr int max_steps = 40;

}  // namespace

BlendInterval::BlendInterval(const Configuration& way, const Configuration& bend, double delta, double most)
    : delta_(delta), max_start_(std::numeric_limits<double>::infinity()) {
  for (int joint = 0; joint < way.size(); ++joint) {
    add(way[joint], bend[joint], joint);
    add(way[joint] + 3 * delta * bend[joint], bend[joint], joint);  // q' + delta q'' there, and x_1 = x_0 + 2 delta s
  }
  add(1 / most, 0, -1);
}

void BlendInterval::add(double alpha, double beta, int joint) {
  if (alpha < 0) {
    alpha = -alpha;
    beta = -beta;
  }
  if (alpha < min_alpha) {
    if (beta != 0) max_start_ = std::min(max_start_, 1 / std::abs(beta));
    return;
  }
  const auto at = static_cast<std::size_t>(bands_++);
  reach_[at] = 1 / alpha;
  slope_[at] = beta / alpha;
  joint_[at] = joint;
}

BlendInterval::Line BlendInterval::upper(double start) const {
  double least = std::numeric_limits<double>::infinity();
  std::size_t binds = 0;
  for (std::size_t at = 0; at < static_cast<std::size_t>(bands_); ++at)
    if (const double s = reach_[at] - slope_[at] * start; s < least) {
      least = s;
      binds = at;
    }
  return {least, -slope_[binds], joint_[binds]};
}

BlendInterval::Line BlendInterval::lower(double start) const {
  double most = -std::numeric_limits<double>::infinity();
  std::size_t binds = 0;
  for (std::size_t at = 0; at < static_cast<std::size_t>(bands_); ++at)
    if (const double s = -reach_[at] - slope_[at] * start; s > most) {
      most = s;
      binds = at;
    }
  return {most, -slope_[binds], joint_[binds]};
}

/// The room between the lines above and those below is concave in x_0, and there is some at 0: Newton from above.
double BlendInterval::max_start(double cap, double end) const {
  double start = std::min(cap, max_start_);
  for (int step = 0; step < max_steps; ++step) {
    Line high = upper(start);
    if (const double s = (end - start) / (2 * delta_); s < high.value) high = {s, -1 / (2 * delta_), -1};
    Line low = lower(start);
    if (const double s = -start / (2 * delta_); s > low.value) low = {s, -1 / (2 * delta_), -1};
    const double room = high.value - low.value;
    const double size =
        std::abs(high.value) + std::abs(low.value) + (std::abs(high.slope) + std::abs(low.slope)) * start;
    if (room >= -rounding * size) return start;
    const double slope = high.slope - low.slope;
    if (!(slope < 0)) return 0;
    start = std::max(0.0, start - room / slope * (1 + 1e-12));
  }
  return 0;
}

double BlendInterval::max_end(double start, double end) const {
  const double s = std::max(upper(start).value, lower(start).value);
  return std::clamp(start + 2 * delta_ * s, 0.0, end);
}

int BlendInterval::binding(double start) const {
  return upper(start).joint;
}

}  // namespace sculpt
