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
  const Eigen::Index joints = way.size();
  Bands alpha(2 * joints + 1), beta(2 * joints + 1);
  alpha << way.array(), way.array() + 3 * delta * bend.array(), 1 / most;  // q' + delta q'', x_1 = x_0 + 2 delta s
  beta << bend.array(), bend.array(), 0;
  reach_ = alpha.abs().inverse();
  slope_ = beta / alpha;
  if (reach_.maxCoeff() < 1 / min_alpha) return;
  for (Eigen::Index at = 0; at < alpha.size(); ++at) {
    if (std::abs(alpha[at]) >= min_alpha) continue;
    if (beta[at] != 0) max_start_ = std::min(max_start_, 1 / std::abs(beta[at]));
    reach_[at] = std::numeric_limits<double>::infinity();
    slope_[at] = 0;
  }
}

Eigen::Index BlendInterval::binding_upper(double start) const {
  Eigen::Index at = 0;
  (reach_ - slope_ * start).minCoeff(&at);
  return at;
}

Eigen::Index BlendInterval::binding_lower(double start) const {
  Eigen::Index at = 0;
  (-reach_ - slope_ * start).maxCoeff(&at);
  return at;
}

/// The room between the lines above and those below is concave in x_0, and there is some at 0: Newton from above.
double BlendInterval::max_start(double cap, double end) const {
  double start = std::min(cap, max_start_);
  for (int step = 0; step < max_steps; ++step) {
    const double by_end = (end - start) / (2 * delta_), by_zero = -start / (2 * delta_), upper_band = upper(start),
                 lower_band = lower(start), high = std::min(upper_band, by_end), low = std::max(lower_band, by_zero);
    if (high >= low) return start;
    const double high_slope = upper_band <= by_end ? -slope_[binding_upper(start)] : -1 / (2 * delta_),
                 low_slope = lower_band >= by_zero ? -slope_[binding_lower(start)] : -1 / (2 * delta_);
    const double size = std::abs(high) + std::abs(low) + (std::abs(high_slope) + std::abs(low_slope)) * start;
    if (high - low >= -rounding * size) return start;
    const double slope = high_slope - low_slope;
    if (!(slope < 0)) return 0;
    start = std::max(0.0, start - (high - low) / slope * (1 + 1e-12));
  }
  return 0;
}

double BlendInterval::max_end(double start, double end) const {
  const double s = std::max(upper(start), lower(start));
  return std::clamp(start + 2 * delta_ * s, 0.0, end);
}

int BlendInterval::binding(double start) const {
  const Eigen::Index at = binding_upper(start), joints = (reach_.size() - 1) / 2;
  return at < 2 * joints ? static_cast<int>(at % joints) : -1;
}

}  // namespace sculpt
