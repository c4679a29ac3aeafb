#include "core/mill/finish/rows/offset_curves.hpp"

#include <algorithm>

#include "core/mill/finish/rows/simplified_curve.hpp"
#include "core/mill/finish/rows/surface_distances.hpp"

namespace sculpt {
namespace {

/// How far a row may be from where it should be (spacings).
constexpr double off_spacings = 0.06;

}  // namespace

std::vector<Curve> offset_curves(const PlanPatch& patch, double first_m, double spacing_m) {
  if (patch.is_inside.empty()) return {};
  std::vector<char> is_outside(patch.is_inside.size());
  std::ranges::transform(patch.is_inside, is_outside.begin(), [](char is_inside) { return is_inside == 0; });
  const std::vector<float> distances = surface_distances(patch, is_outside);
  const double most = static_cast<double>(*std::ranges::max_element(distances));
  std::vector<Curve> curves;
  for (int row = 0; first_m + row * spacing_m < most; ++row)
    for (const Curve& curve : level_curves(distances, patch.lattice, first_m + row * spacing_m))
      curves.push_back(simplified(curve, off_spacings * spacing_m));
  return curves;
}

}  // namespace sculpt
