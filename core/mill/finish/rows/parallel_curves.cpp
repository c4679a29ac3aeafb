#include "core/mill/finish/rows/parallel_curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/mill/finish/rows/simplified_curve.hpp"
#include "core/mill/finish/rows/surface_distances.hpp"

namespace sculpt {
namespace {

/// How far a row may be from where it should be (spacings).
constexpr double row_off_spacings = 0.06;

/// Of cells from one side of the lattice.
std::vector<float> distances_from_side(const PlanPatch& patch, bool along_u) {
  std::vector<char> is_source(patch.lattice.size());
  for (int at = 0; at < (along_u ? patch.lattice.width : patch.lattice.height); ++at)
    is_source[along_u ? patch.lattice.index(at, 0) : patch.lattice.index(0, at)] = 1;
  return surface_distances(patch, is_source);
}

/// The parts of a curve that are inside of a patch.
void add_inside(const PlanPatch& patch, const Curve& curve, double off_m, std::vector<Curve>& parts) {
  Curve part;
  const auto end_part = [&] {
    if (part.size() > 1) parts.push_back(simplified(part, off_m));
    part.clear();
  };
  for (const Point2& at : curve) {
    const int a = patch.lattice.cell_u(at.x()), b = patch.lattice.cell_v(at.y());
    if (patch.lattice.contains(a, b) && patch.is_inside[patch.lattice.index(a, b)] != 0)
      part.push_back(at);
    else
      end_part();
  }
  end_part();
}

}  // namespace

std::vector<Curve> parallel_curves(const PlanPatch& patch, double reach_m, double spacing_m, bool along_u) {
  if (patch.is_inside.empty()) return {};
  const std::vector<float> distances = distances_from_side(patch, along_u);
  double first = std::numeric_limits<double>::infinity(), last = 0;
  for (std::size_t cell = 0; cell < distances.size(); ++cell) {
    if (patch.is_inside[cell] == 0) continue;
    first = std::min(first, static_cast<double>(distances[cell]));
    last = std::max(last, static_cast<double>(distances[cell]));
  }
  first += reach_m;
  last = std::max(first, last - reach_m);
  const double rows = std::max(1.0, std::ceil((last - first) / spacing_m)), apart = (last - first) / rows;
  std::vector<Curve> curves;
  for (double row = 0.5; row < rows; ++row)
    for (const Curve& curve : level_curves(distances, patch.lattice, first + row * apart))
      add_inside(patch, curve, row_off_spacings * spacing_m, curves);
  return curves;
}

}  // namespace sculpt
