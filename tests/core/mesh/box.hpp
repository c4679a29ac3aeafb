// A box as a mesh, for tests.
#pragma once

#include <array>

#include "core/mesh/mesh.hpp"

namespace sculpt {

/// Corner n is at x, y, z as its bits 0, 1, 2 say; triangles turn so that normals point out.
inline Mesh box_between(const std::array<Vec3, 8>& corners) {
  Mesh mesh;
  mesh.vertices.assign(corners.begin(), corners.end());
  using Side = std::array<std::uint32_t, 4>;
  for (const auto& [a, b, c, d] :
       {Side{0, 2, 3, 1}, Side{4, 5, 7, 6}, Side{0, 1, 5, 4}, Side{2, 6, 7, 3}, Side{0, 4, 6, 2}, Side{1, 3, 7, 5}}) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return mesh;
}

}  // namespace sculpt
