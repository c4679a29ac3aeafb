#include "core/mill/finish/tour/contour_steps.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sculpt {
namespace {

/// An edge that is led over the part once more may come to be so many times as long, and a little more.
constexpr double detour = 3, detour_m = 1e-5;
constexpr double same_m = 1e-6;

/// At rest all the way; nothing where that is not found.
Contour edge_between(const Vec3& from, const Vec3& to, const EnvelopeTask& task) {
  return follow_whole(task, from.head<2>(), to.head<2>(), detour * (to - from).norm() + detour_m);
}

/// From `end`, on the edge from a corner to another, to that other; from the corner where that fails.
Contour part_of_edge(const Vec3& end, const Vec3& before, const Vec3& corner, const EnvelopeTask& task) {
  Contour part = edge_between(end, corner, task);
  if (part.empty() || (part.back() - corner).norm() > same_m) return {before, corner};
  part.back() = corner;
  return part;
}

}  // namespace

ContourSteps in_steps(const Contour& contour, double step_m) {
  ContourSteps steps{{contour.front()}, {0}};
  for (std::size_t edge = 0; edge + 1 < contour.size(); ++edge) {
    const Vec3& from = contour[edge];
    const Vec3 way = contour[edge + 1] - from;
    const double count = std::max(1.0, std::ceil(way.norm() / step_m));
    for (double step = 1; step < count; ++step) steps.places.emplace_back(from + step / count * way);
    steps.places.push_back(contour[edge + 1]);
    steps.corners.push_back(steps.places.size() - 1);
  }
  return steps;
}

Contour part_of(const ContourSteps& steps, const StepSpan& span, const EnvelopeTask& task) {
  const auto& [places, corners] = steps;
  // The corner at or before the first place, and that at or after the last one.
  const auto from = std::ranges::upper_bound(corners, span.first) - 1,
             to = std::ranges::lower_bound(corners, span.last);
  Contour part;
  for (auto corner = from; corner <= to; ++corner) part.push_back(places[*corner]);
  const bool begins_between = *from != span.first, ends_between = *to != span.last;
  if (part.size() == 2 && (begins_between || ends_between)) {
    Contour inner = edge_between(places[span.first], places[span.last], task);
    return inner.empty() ? part : inner;
  }
  if (begins_between) {
    const Contour begin = part_of_edge(places[span.first], part[0], part[1], task);
    part.erase(part.begin(), part.begin() + 2);
    part.insert(part.begin(), begin.begin(), begin.end());
  }
  if (ends_between) {
    const Contour end = part_of_edge(places[span.last], part.back(), part[part.size() - 2], task);
    part.resize(part.size() - 2);
    std::ranges::copy(end.rbegin(), end.rend(), std::back_inserter(part));
  }
  return part;
}

}  // namespace sculpt
