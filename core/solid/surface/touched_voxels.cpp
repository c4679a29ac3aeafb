#include "core/solid/surface/touched_voxels.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sculpt {
namespace {

/// Of a voxel's edge, that belongs to nobody at its sides.
constexpr double border = 1e-6;

using Polygon = std::vector<Vec3>;  // convex, in voxels

/// The part of it on one side: where `sign` times the coordinate is no less than `sign` times the limit.
Polygon cut_off(const Polygon& polygon, int axis, double limit, double sign) {
  Polygon kept;
  for (std::size_t at = 0; at < polygon.size(); ++at) {
    const Vec3 &here = polygon[at], &next = polygon[(at + 1) % polygon.size()];
    const double above = sign * (here[axis] - limit), then = sign * (next[axis] - limit);
    if (above >= 0) kept.push_back(here);
    if ((above < 0) != (then < 0)) kept.push_back(here + (next - here) * (above / (above - then)));
  }
  return kept;
}

struct Range {
  int first, last;
};

/// Layers of voxels across an axis that hold some of it.
Range layers(const Polygon& polygon, int axis, int n) {
  const auto less = [axis](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; };
  const auto [low, high] = std::minmax_element(polygon.begin(), polygon.end(), less);
  const auto whole = [n](double value) { return static_cast<int>(std::clamp(value, -1.0, static_cast<double>(n))); };
  return {std::max(0, whole(std::ceil((*low)[axis] - 1 + border))),
          std::min(n - 1, whole(std::floor((*high)[axis] - border)))};
}

Polygon in_layer(const Polygon& polygon, int axis, int layer) {
  return cut_off(cut_off(polygon, axis, layer + border, 1), axis, layer + 1 - border, -1);
}

void add_touched(const Polygon& facet, VoxelSet& touched) {
  const int n = touched.n();
  const Range up = layers(facet, 2, n);
  for (int k = up.first; k <= up.last; ++k) {
    const Polygon slice = in_layer(facet, 2, k);
    if (slice.empty()) continue;
    const Range across = layers(slice, 1, n);
    for (int j = across.first; j <= across.last; ++j) {
      const Polygon piece = in_layer(slice, 1, j);
      if (piece.empty()) continue;
      const Range along = layers(piece, 0, n);
      for (int i = along.first; i <= along.last; ++i) touched.insert({i, j, k});
    }
  }
}

}  // namespace

VoxelSet touched_voxels(const Mesh& mesh, const Grid& grid, const Watch& watch) {
  VoxelSet touched(grid.n);
  for (const auto& t : mesh.triangles) {
    if (watch.stop.stop_requested()) throw Cancelled{};
    Polygon facet;
    for (const std::uint32_t vertex : t) facet.emplace_back((mesh.vertices[vertex] - grid.origin_m) / grid.voxel_m);
    add_touched(facet, touched);
  }
  return touched;
}

}  // namespace sculpt
