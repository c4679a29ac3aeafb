// Which facets meet at which edge.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sculpt {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// One side of a facet: it joins the vertices `low` < `high`, and `forward` if the facet goes from low to high.
struct Side {
  std::uint32_t low, high;
  std::uint32_t facet : 31, forward : 1;
};

/// All sides, those of one edge together; edges by their vertices, sides of an edge by facet. No facet may name a
/// vertex twice. Needs 12 bytes a side.
std::vector<Side> sort_sides(const Triangles& triangles, std::size_t vertices);

/// Calls `visit` with the sides of each edge.
template <typename Visit>
void for_each_edge(const std::vector<Side>& sides, const Visit& visit) {
  for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
    while (end < sides.size() && sides[end].low == sides[first].low && sides[end].high == sides[first].high) ++end;
    visit(std::span<const Side>(&sides[first], end - first));
  }
}

}  // namespace sculpt
