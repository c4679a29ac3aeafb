#include "core/cell/milling/mill_tool.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {

const char* name(CutterKind kind) {
  switch (kind) {
    case CutterKind::ball:
      return "ball";
    case CutterKind::bull:
      return "bull";
    case CutterKind::flat:
      return "flat";
  }
  return "unknown";
}

double Cutter::height_m(double r_m) const {
  const double from_rim = r_m - (radius_m - corner_radius_m);
  if (from_rim <= 0) return 0;
  return corner_radius_m - std::sqrt(std::max(0.0, corner_radius_m * corner_radius_m - from_rim * from_rim));
}

}  // namespace sculpt
