#include "core/solid/fixed_mesh.hpp"

#include <cmath>

#include "core/base/error.hpp"
#include "core/mesh/vertex_join.hpp"

namespace sculpt {
namespace {

constexpr double units_an_edge = std::int64_t{1} << unit_bits;

Vec3 round_to_units(const Vec3& vertex, const Grid& grid) {
  constexpr double limit = 8192;  // voxels; products of two coordinates then stay below 2^62
  const Vec3 at = (vertex - grid.origin_m) / grid.voxel_m;
  if (!(at.cwiseAbs().maxCoeff() < limit))
    throw InputError("target_outside_stock",
                     "the mesh reaches more than 8192 voxels out of the grid: check its units (metres) and its place");
  return {std::round(at.x() * units_an_edge), std::round(at.y() * units_an_edge), std::round(at.z() * units_an_edge)};
}

}  // namespace

FixedMesh to_fixed(const Mesh& mesh, const Grid& grid) {
  std::vector<Vec3> points;
  VertexJoin join(points, mesh.vertices.size());
  std::vector<std::uint32_t> ids;
  ids.reserve(mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices) ids.push_back(join.add(round_to_units(vertex, grid)));
  FixedMesh fixed;
  fixed.vertices.reserve(points.size());
  for (const Vec3& point : points)
    fixed.vertices.push_back({static_cast<std::int64_t>(point.x()), static_cast<std::int64_t>(point.y()),
                              static_cast<std::int64_t>(point.z())});
  fixed.triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles)
    if (ids[a] != ids[b] && ids[b] != ids[c] && ids[c] != ids[a]) fixed.triangles.push_back({ids[a], ids[b], ids[c]});
  return fixed;
}

}  // namespace sculpt
