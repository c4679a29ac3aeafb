// Small parts of quadrilaterals, alone and in a grid.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "core/material/voxel_grid.hpp"
#include "core/mesh/mesh.hpp"

namespace sculpt {

/// Each as two triangles.
inline Mesh quads(const std::vector<std::array<Vec3, 4>>& faces) {
  Mesh mesh;
  for (const auto& face : faces) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), face.begin(), face.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  return mesh;
}

struct PartInGrid {
  Mesh mesh;
  VoxelGrid voxels;
  Grid grid;
};

/// In a grid of 32 voxels an edge from the origin on.
inline PartInGrid in_grid(Mesh mesh, double edge_m, const std::function<bool(const Voxel&)>& is_part) {
  constexpr int n = 32;
  PartInGrid part{std::move(mesh), {VoxelSet(n, true), VoxelSet(n)}, {}};
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        if (is_part({i, j, k})) part.voxels.keep.insert({i, j, k});
  part.grid.n = n;
  part.grid.voxel_m = edge_m / n;
  part.grid.origin_m = Vec3::Zero();
  return part;
}

}  // namespace sculpt
