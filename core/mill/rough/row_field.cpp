#include "core/mill/rough/row_field.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {

double RowField::at(const Point2& p) const {
  const double x = (p.x() - lattice.low_u) / lattice.step - 0.5, y = (p.y() - lattice.low_v) / lattice.step - 0.5;
  const int a = std::clamp(static_cast<int>(std::floor(x)), 0, lattice.width - 2),
            b = std::clamp(static_cast<int>(std::floor(y)), 0, lattice.height - 2);
  const double s = std::clamp(x - a, 0.0, 1.0), t = std::clamp(y - b, 0.0, 1.0);
  const auto value = [&](int da, int db) { return static_cast<double>(values[lattice.index(a + da, b + db)]); };
  return (1 - t) * ((1 - s) * value(0, 0) + s * value(1, 0)) + t * ((1 - s) * value(0, 1) + s * value(1, 1));
}

Point2 RowField::outwards(const Point2& p) const {
  const Point2 u(lattice.step, 0), v(0, lattice.step), slope(at(p + u) - at(p - u), at(p + v) - at(p - v));
  return slope.norm() > 0 ? Point2(slope.normalized()) : Point2(0, 1);
}

}  // namespace sculpt
