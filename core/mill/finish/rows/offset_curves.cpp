#include "core/mill/finish/rows/offset_curves.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/mill/finish/rows/simplified_curve.hpp"
#include "core/mill/finish/rows/surface_distances.hpp"

namespace sculpt {
namespace {

/// How far a row may be from where it should be (spacings).
constexpr double off_spacings = 0.06;

}  // namespace

std::vector<Curve> offset_curves(const PlanPatch& patch, double first_m, double spacing_m, const Helpers& helpers) {
  if (patch.is_inside.empty()) return {};
  std::vector<char> is_outside(patch.is_inside.size());
  std::ranges::transform(patch.is_inside, is_outside.begin(), [](char is_inside) { return is_inside == 0; });
  const std::vector<float> distances = surface_distances(patch, is_outside);
  const double most = static_cast<double>(*std::ranges::max_element(distances));
  const auto rings = static_cast<std::size_t>(std::max(0.0, std::ceil((most - first_m) / spacing_m)));
  std::vector<std::vector<Curve>> found(rings);
  helpers.for_each_index(rings, [&](std::size_t ring) {
    for (const Curve& curve : level_curves(distances, patch.lattice, first_m + static_cast<double>(ring) * spacing_m))
      found[ring].push_back(simplified(curve, off_spacings * spacing_m));
  });
  std::vector<Curve> curves;
  for (auto& each : found) std::ranges::move(each, std::back_inserter(curves));
  return curves;
}

}  // namespace sculpt
