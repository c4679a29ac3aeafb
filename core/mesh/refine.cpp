#include "core/mesh/refine.hpp"

#include <algorithm>
#include <unordered_map>

namespace sculpt {
namespace {

/// The vertices in the middle of edges that were halved.
class Middles {
 public:
  Middles(std::vector<Vec3>& vertices, double edge) : vertices_(vertices), edge_(edge) {}

  bool is_long(std::uint32_t a, std::uint32_t b) const { return (vertices_[a] - vertices_[b]).norm() > edge_; }

  std::uint32_t of(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax(a, b);
    const auto [at, is_new] =
        numbers_.try_emplace(std::uint64_t{low} << 32 | high, static_cast<std::uint32_t>(vertices_.size()));
    if (is_new) vertices_.emplace_back((vertices_[low] + vertices_[high]) / 2);
    return at->second;
  }

 private:
  std::vector<Vec3>& vertices_;
  double edge_;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;
};

/// Halves the long edges of a triangle: all that a neighbour halves too.
void split(const std::array<std::uint32_t, 3>& t, Middles& middles,
           std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::array<bool, 3> is_long{};
  for (std::size_t side = 0; side < 3; ++side) is_long[side] = middles.is_long(t[side], t[(side + 1) % 3]);
  const auto count = std::ranges::count(is_long, true);
  if (count == 0) return triangles.push_back(t);
  // Turned so that the first side is long and, of two, the last one is short.
  std::size_t first = 0;
  while (!is_long[first] || (count == 2 && is_long[(first + 2) % 3])) ++first;
  const std::uint32_t a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3], ab = middles.of(a, b);
  if (count == 1) {
    triangles.push_back({a, ab, c});
    triangles.push_back({ab, b, c});
    return;
  }
  const std::uint32_t bc = middles.of(b, c);
  triangles.push_back({ab, b, bc});
  if (count == 2) {
    triangles.push_back({a, ab, bc});
    triangles.push_back({a, bc, c});
    return;
  }
  const std::uint32_t ca = middles.of(c, a);
  triangles.push_back({a, ab, ca});
  triangles.push_back({ca, bc, c});
  triangles.push_back({ab, bc, ca});
}

}  // namespace

Mesh refine(Mesh mesh, double edge, std::size_t enough) {
  for (std::size_t before = 0; before != mesh.triangles.size() && mesh.triangles.size() < enough;) {
    before = mesh.triangles.size();
    Middles middles(mesh.vertices, edge);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const auto& triangle : mesh.triangles) split(triangle, middles, triangles);
    mesh.triangles = std::move(triangles);
  }
  return mesh;
}

}  // namespace sculpt
