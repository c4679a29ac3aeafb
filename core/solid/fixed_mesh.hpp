// Mesh -> FixedMesh: the integers on which inside and outside are decided.
#pragma once

#include "core/material/voxel.hpp"
#include "core/mesh/mesh.hpp"
#include "core/solid/surface/sides.hpp"

namespace sculpt {

/// Vertices in 1/65536 of a voxel edge, relative to the grid's corner; those at one point are one. Facets that have
/// become a line or a point are left out.
constexpr int unit_bits = 16;
struct FixedMesh {
  std::vector<std::array<std::int64_t, 3>> vertices;
  Triangles triangles;

  /// In units, exact up to 2^53.
  Vec3 at(std::uint32_t vertex) const {
    const auto& v = vertices[vertex];
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
  }
};

/// Throws InputError `target_outside_stock` for a mesh that reaches out of the grid so far that the integers would
/// overflow.
FixedMesh to_fixed(const Mesh& mesh, const Grid& grid);

}  // namespace sculpt
