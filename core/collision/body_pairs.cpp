#include "core/collision/body_pairs.hpp"

#include <map>

#include "core/collision/margins.hpp"

namespace sculpt {
namespace {

/// Of a gap at home that is less than the margin. Edges that start there move on for the rest.
constexpr double share_of_gap = 0.6;

using Shapes = std::vector<std::size_t>;

/// Shapes of the first link, and shapes of the second one that all of them must be kept apart from.
std::vector<std::pair<Shapes, Shapes>> group_shapes(const CheckedLinks& checked) {
  std::map<std::size_t, Shapes> partners;
  for (const auto& [first, second] : checked.shapes) partners[first].push_back(second);
  std::map<Shapes, Shapes> alike;
  for (const auto& [first, seconds] : partners) alike[seconds].push_back(first);
  std::vector<std::pair<Shapes, Shapes>> groups;
  groups.reserve(alike.size());
  for (const auto& [seconds, firsts] : alike) groups.emplace_back(firsts, seconds);
  return groups;
}

/// The body, or a new one that is a part of it.
std::size_t body_of(std::vector<Body>& bodies, std::size_t body, const Shapes& shapes) {
  if (shapes.size() == bodies[body].parts.size()) return body;
  bodies.push_back(part_of(bodies[body], shapes));
  return bodies.size() - 1;
}

}  // namespace

std::vector<BodyPair> pair_bodies(std::vector<Body>& bodies, std::size_t first, std::size_t second,
                                  const CheckedLinks& checked) {
  const bool is_tight = checked.gap_m > 0 && checked.gap_m < link_margin_m;
  const double margin_m = is_tight ? share_of_gap * checked.gap_m : link_margin_m;
  std::vector<BodyPair> pairs;
  for (const auto& [firsts, seconds] : group_shapes(checked)) {
    const std::size_t one = body_of(bodies, first, firsts);
    pairs.push_back({one, body_of(bodies, second, seconds), margin_m});
  }
  return pairs;
}

}  // namespace sculpt
