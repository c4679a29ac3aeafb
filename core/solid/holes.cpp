#include "core/solid/holes.hpp"

#include <algorithm>

#include "core/solid/facet_groups.hpp"

namespace sculpt {

std::vector<Hole> find_holes(const FixedMesh& mesh, const std::vector<OpenEdge>& edges) {
  using Corner = std::pair<std::uint32_t, std::uint32_t>;  // group and vertex
  std::vector<Corner> corners;
  for (const OpenEdge& edge : edges) corners.insert(corners.end(), {{edge.group, edge.a}, {edge.group, edge.b}});
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  const auto number = [&](const Corner& corner) {
    return static_cast<std::uint32_t>(std::lower_bound(corners.begin(), corners.end(), corner) - corners.begin());
  };
  FacetGroups joined(corners.size());
  for (const OpenEdge& edge : edges) joined.join(number({edge.group, edge.a}), number({edge.group, edge.b}), false);

  std::vector<Hole> holes;
  std::vector<std::size_t> hole_of(corners.size(), edges.size());
  for (std::uint32_t c = 0; c < corners.size(); ++c) {
    std::size_t& hole = hole_of[joined.find(c).root];
    if (hole == edges.size()) {
      hole = holes.size();
      holes.push_back({corners[c].first, 0, {}});
    }
    holes[hole].box.extend(mesh.at(corners[c].second));
  }
  for (const OpenEdge& edge : edges)
    holes[hole_of[joined.find(number({edge.group, edge.a})).root]].length += (mesh.at(edge.a) - mesh.at(edge.b)).norm();
  return holes;
}

std::vector<OpenEdge> find_open_edges(const std::vector<Side>& sides) {
  std::vector<OpenEdge> open;
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() % 2 != 0) open.push_back({0, edge[0].low, edge[0].high});
  });
  return open;
}

}  // namespace sculpt
