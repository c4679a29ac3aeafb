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

/// A box that fills the lower half of a grid.
inline PartInGrid make_slab(double edge_m) {
  const auto corner = [&](int number) {
    return Vec3(number & 1 ? edge_m : 0.0, number & 2 ? edge_m : 0.0, number & 4 ? edge_m / 2 : 0.0);
  };
  std::vector<std::array<Vec3, 4>> faces;
  for (const auto& [a, b, c, d] : std::array<std::array<int, 4>, 6>{
           {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}})
    faces.push_back({corner(a), corner(b), corner(c), corner(d)});
  return in_grid(quads(faces), edge_m, [](const Voxel& voxel) { return voxel.k < 16; });
}

}  // namespace sculpt
