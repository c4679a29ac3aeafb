// The loops of edges at which a surface ends.
#pragma once

#include "core/solid/fixed_mesh.hpp"

namespace sculpt {

/// An edge at which `group`, a number of facets, ends.
struct OpenEdge {
  std::uint32_t group, a, b;  ///< vertices a and b
};

/// Open edges of one group that hang together. Units of the mesh.
struct Hole {
  std::uint32_t group;
  double length = 0;
  Eigen::AlignedBox3d box;
};

/// Holes by group, then by the lowest of their vertices.
std::vector<Hole> find_holes(const FixedMesh& mesh, const std::vector<OpenEdge>& edges);

/// The edges with an odd number of facets, all in group 0.
std::vector<OpenEdge> find_open_edges(const std::vector<Side>& sides);

}  // namespace sculpt
