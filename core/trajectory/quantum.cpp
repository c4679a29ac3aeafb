#include "core/trajectory/quantum.hpp"

namespace sculpt {

Configuration rounded(const Configuration& q) {
  // + 0.0 drops the sign of -0.
  return q.unaryExpr([](double value) { return std::nearbyint(value * quanta_per_unit) / quanta_per_unit + 0.0; });
}

Configuration rounded(const Configuration& q, const Configuration& lower, const Configuration& upper) {
  Configuration stored = rounded(q);
  for (Eigen::Index at = 0; at < q.size(); ++at)
    if (const int step = (stored[at] < lower[at]) - (stored[at] > upper[at]); step != 0)
      stored[at] = from_quanta(std::llround(stored[at] * quanta_per_unit) + step);
  return stored;
}

}  // namespace sculpt
