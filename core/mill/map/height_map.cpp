#include "core/mill/map/height_map.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/mill/map/float_bound.hpp"

namespace sculpt {
namespace {

/// Voxels of these layers of which the neighbour along one of the axis' steps does not stand, or is outside.
template <typename Visit>
void for_each_upper_voxel(const VoxelSet& standing, const Direction& direction, int first_k, int end_k,
                          const Visit& visit) {
  const int n = standing.n();
  const auto stands = [&](Voxel v) {
    return v.i >= 0 && v.j >= 0 && v.k >= 0 && v.i < n && v.j < n && v.k < n && standing.contains(v);
  };
  std::array<Voxel, 3> steps{};
  std::size_t count = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (direction[static_cast<std::size_t>(axis)] != 0) {
      const int way = direction[static_cast<std::size_t>(axis)] > 0 ? 1 : -1;
      steps[count++] = {axis == 0 ? way : 0, axis == 1 ? way : 0, axis == 2 ? way : 0};
    }
  const auto& words = standing.words();
  const std::size_t row_words = std::max<std::size_t>(1, static_cast<std::size_t>(n) / 64);
  if (n < 64) {
    for_each_voxel(standing, [&](Voxel v) {
      for (std::size_t s = 0; s < count && v.k >= first_k && v.k < end_k; ++s)
        if (!stands(v + steps[s])) return visit(v);
    });
    return;
  }
  const auto row = [&](int j, int k) -> const std::uint64_t* {
    if (j < 0 || k < 0 || j >= n || k >= n) return nullptr;
    return words.data() +
           (static_cast<std::size_t>(j) + static_cast<std::size_t>(n) * static_cast<std::size_t>(k)) * row_words;
  };
  for (int k = first_k; k < end_k; ++k)
    for (int j = 0; j < n; ++j) {
      const std::uint64_t* here = row(j, k);
      for (std::size_t word = 0; word < row_words; ++word) {
        if (here[word] == 0) continue;
        std::uint64_t covered = ~std::uint64_t{0};  // by a neighbour along every step
        for (std::size_t s = 0; s < count; ++s) {
          std::uint64_t beside = 0;
          if (steps[s].i > 0)
            beside = here[word] >> 1 | (word + 1 < row_words ? here[word + 1] << 63 : 0);
          else if (steps[s].i < 0)
            beside = here[word] << 1 | (word > 0 ? here[word - 1] >> 63 : 0);
          else if (const std::uint64_t* other = row(j + steps[s].j, k + steps[s].k))
            beside = other[word];
          covered &= beside;
        }
        for (std::uint64_t bits = here[word] & ~covered; bits != 0; bits &= bits - 1)
          visit(Voxel{static_cast<int>(64 * word) + std::countr_zero(bits), j, k});
      }
    }
}

}  // namespace

Lattice lattice_over(const ToolFrame& frame, const Vec3& low, const Vec3& high, double margin_m, double step_m) {
  Eigen::AlignedBox2d box;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 at =
        frame.of({(corner & 1 ? high : low).x(), (corner & 2 ? high : low).y(), (corner & 4 ? high : low).z()});
    box.extend(Eigen::Vector2d(at.x(), at.y()));
  }
  Lattice lattice{box.min().x() - margin_m, box.min().y() - margin_m, step_m, 0, 0};
  lattice.width = static_cast<int>(std::ceil((box.sizes().x() + 2 * margin_m) / step_m));
  lattice.height = static_cast<int>(std::ceil((box.sizes().y() + 2 * margin_m) / step_m));
  return lattice;
}

/// In each cell the highest point of the plane over the cell, where that is lower than the triangle's top.
void HeightMap::raise(const Vec3& p, const Vec3& q, const Vec3& r) {
  const double top = std::max({p.z(), q.z(), r.z()});
  const double min_u = std::min({p.x(), q.x(), r.x()}), max_u = std::max({p.x(), q.x(), r.x()});
  const double min_v = std::min({p.y(), q.y(), r.y()}), max_v = std::max({p.y(), q.y(), r.y()});
  const int first_a = std::max(0, lattice.cell_u(min_u - 1e-9)),
            last_a = std::min(lattice.width - 1, lattice.cell_u(max_u + 1e-9));
  const int first_b = std::max(0, lattice.cell_v(min_v - 1e-9)),
            last_b = std::min(lattice.height - 1, lattice.cell_v(max_v + 1e-9));
  if (first_a > last_a || first_b > last_b) return;
  const float whole = above(top);
  if (last_a - first_a <= 1 && last_b - first_b <= 1) {
    for (int b = first_b; b <= last_b; ++b)
      for (int a = first_a; a <= last_a; ++a) raise(a, b, whole);
    return;
  }
  // Slopes of the plane, infinite where it stands upright.
  const Vec3 e = q - p, f = r - p;
  const double area = e.x() * f.y() - e.y() * f.x();
  const bool upright = std::abs(area) < 1e-18;
  const double slope_u = upright ? 0 : (e.z() * f.y() - f.z() * e.y()) / area,
               slope_v = upright ? 0 : (f.z() * e.x() - e.z() * f.x()) / area;
  const double rise = (std::abs(slope_u) + std::abs(slope_v)) * lattice.step / 2;
  // Of each edge the side on which the triangle is, and how far a cell reaches across it.
  struct Edge {
    double nu, nv, offset, reach;
  };
  std::array<Edge, 3> edges{};
  const std::array<Vec3, 3> corners{p, q, r};
  for (std::size_t at = 0; at < 3; ++at) {
    const Vec3 &a = corners[at], &b = corners[(at + 1) % 3];
    double nu = b.y() - a.y(), nv = a.x() - b.x();
    if (area < 0) nu = -nu, nv = -nv;
    edges[at] = {nu, nv, nu * a.x() + nv * a.y(), (std::abs(nu) + std::abs(nv)) * (lattice.step / 2 + 1e-9) + 1e-15};
  }
  for (int b = first_b; b <= last_b; ++b)
    for (int a = first_a; a <= last_a; ++a) {
      const double u = lattice.u(a), v = lattice.v(b);
      bool apart = false;
      for (const Edge& edge : edges)
        apart = apart || (!upright && edge.nu * u + edge.nv * v - edge.offset > edge.reach);
      if (apart) continue;
      const double plane = upright ? top : p.z() + slope_u * (u - p.x()) + slope_v * (v - p.y()) + rise;
      raise(a, b, plane < top ? above(plane) : whole);
    }
}

void HeightMap::raise(const HeightMap& other) {
  for (std::size_t at = 0; at < heights.size(); ++at) heights[at] = std::max(heights[at], other.heights[at]);
}

HeightMap heights_of(const VoxelSet& standing, const Grid& grid, const ToolFrame& frame, const Lattice& lattice,
                     const Helpers& helpers, const HeightMap* floor) {
  // A cube's silhouette lies within half of its extent along each axis of the frame.
  const double half_u = grid.voxel_m / 2 * frame.u.cwiseAbs().sum(),
               half_v = grid.voxel_m / 2 * frame.v.cwiseAbs().sum(),
               half_w = grid.voxel_m / 2 * frame.w.cwiseAbs().sum();
  const auto raise_voxel = [&](HeightMap& map, Voxel v) {
    const Vec3 at = frame.of(grid.centre(v));
    if (floor != nullptr) {
      const int a = lattice.cell_u(at.x()), b = lattice.cell_v(at.y());
      if (lattice.contains(a, b) && at.z() < static_cast<double>(floor->at(a, b))) return;
    }
    const float top = above(at.z() + half_w);
    const int first_a = std::max(0, lattice.cell_u(at.x() - half_u - 1e-9)),
              last_a = std::min(lattice.width - 1, lattice.cell_u(at.x() + half_u + 1e-9));
    const int first_b = std::max(0, lattice.cell_v(at.y() - half_v - 1e-9)),
              last_b = std::min(lattice.height - 1, lattice.cell_v(at.y() + half_v + 1e-9));
    for (int b = first_b; b <= last_b; ++b)
      for (int a = first_a; a <= last_a; ++a) map.raise(a, b, top);
  };
  // Layers for each thread, and the higher of what they give.
  const int n = grid.n, parts = std::min(n, helpers.threads());
  std::vector<HeightMap> maps(static_cast<std::size_t>(parts), HeightMap(lattice));
  helpers.for_each_index(maps.size(), [&](std::size_t part) {
    const int number = static_cast<int>(part);
    for_each_upper_voxel(standing, frame.direction, n * number / parts, n * (number + 1) / parts,
                         [&](Voxel v) { raise_voxel(maps[part], v); });
  });
  for (std::size_t part = 1; part < maps.size(); ++part) maps[0].raise(maps[part]);
  return std::move(maps[0]);
}

}  // namespace sculpt
