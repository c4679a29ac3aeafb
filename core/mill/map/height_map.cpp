#include "core/mill/map/height_map.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/material/voxel_rows.hpp"
#include "core/mill/map/cell_box.hpp"
#include "core/mill/map/float_bound.hpp"

namespace sculpt {
namespace {

/// Steps from a voxel to its neighbours upwards, one for each axis that the direction leans along.
std::vector<Voxel> steps_up(const Direction& direction) {
  std::vector<Voxel> steps;
  const auto sign = [&](std::size_t axis) { return (direction[axis] > 0) - (direction[axis] < 0); };
  for (const Voxel step : {Voxel{sign(0), 0, 0}, Voxel{0, sign(1), 0}, Voxel{0, 0, sign(2)}})
    if (step.i != 0 || step.j != 0 || step.k != 0) steps.push_back(step);
  return steps;
}

/// Of a chunk of a row those voxels, a bit each, whose neighbours one step away stand; outside of the grid none does.
std::uint64_t stands_beside(const VoxelSet& standing, const VoxelRows& rows, Voxel step, int j, int k, int chunk) {
  const int n = rows.n;
  j += step.j;
  k += step.k;
  if (j < 0 || k < 0 || j >= n || k >= n) return 0;
  const std::uint64_t here = rows.get(standing, j, k, chunk);
  if (step.i > 0)
    return here >> 1 | (chunk + 1 < rows.chunks ? rows.get(standing, j, k, chunk + 1) << (rows.width - 1) : 0);
  if (step.i < 0) return here << 1 | (chunk > 0 ? rows.get(standing, j, k, chunk - 1) >> (rows.width - 1) : 0);
  return here;
}

/// Of a chunk of a row those that stand and of which a neighbour upwards does not, or is outside.
std::uint64_t upper_voxels(const VoxelSet& standing, const VoxelRows& rows, const std::vector<Voxel>& steps, int j,
                           int k, int chunk) {
  const std::uint64_t here = rows.get(standing, j, k, chunk);
  std::uint64_t covered = here;
  for (const Voxel step : steps)
    if (covered != 0) covered &= stands_beside(standing, rows, step, j, k, chunk);
  return here & ~covered;
}

/// A triangle seen along the axis, and the plane that it lies in.
class FlatTriangle {
 public:
  FlatTriangle(const Vec3& p, const Vec3& q, const Vec3& r, double cell_m) : corner_(p) {
    const Vec3 e = q - p, f = r - p;
    const double area = e.x() * f.y() - e.y() * f.x();
    is_upright_ = std::abs(area) < 1e-18;
    if (is_upright_) return;
    slope_u_ = (e.z() * f.y() - f.z() * e.y()) / area;
    slope_v_ = (f.z() * e.x() - e.z() * f.x()) / area;
    rise_ = (std::abs(slope_u_) + std::abs(slope_v_)) * cell_m / 2;
    const std::array<Vec3, 3> corners{p, q, r};
    for (std::size_t at = 0; at < 3; ++at) {
      const Vec3 &a = corners[at], &b = corners[(at + 1) % 3];
      double nu = b.y() - a.y(), nv = a.x() - b.x();
      if (area < 0) nu = -nu, nv = -nv;
      edges_[at] = {nu, nv, nu * a.x() + nv * a.y(), (std::abs(nu) + std::abs(nv)) * (cell_m / 2 + 1e-9) + 1e-15};
    }
  }

  /// Does it stand upright? Then its plane has no height over a place.
  bool is_upright() const { return is_upright_; }
  /// Is none of it in the cell around a middle?
  bool misses(double u, double v) const {
    return !is_upright_ && std::ranges::any_of(edges_, [&](const Edge& edge) {
      return edge.nu * u + edge.nv * v - edge.offset > edge.reach;
    });
  }
  /// The highest point of the plane over the cell.
  double top_over(double u, double v) const {
    return corner_.z() + slope_u_ * (u - corner_.x()) + slope_v_ * (v - corner_.y()) + rise_;
  }

 private:
  /// On which side the triangle is, and how far a cell reaches across it.
  struct Edge {
    double nu = 0, nv = 0, offset = 0, reach = 0;
  };

  Vec3 corner_;
  bool is_upright_ = false;
  double slope_u_ = 0, slope_v_ = 0, rise_ = 0;
  std::array<Edge, 3> edges_;
};

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
  const CellBox cells = cells_over(lattice, std::min({p.x(), q.x(), r.x()}), std::max({p.x(), q.x(), r.x()}),
                                   std::min({p.y(), q.y(), r.y()}), std::max({p.y(), q.y(), r.y()}));
  if (cells.is_empty()) return;
  const double top = std::max({p.z(), q.z(), r.z()});
  const float whole = above(top);
  if (cells.last_a - cells.first_a <= 1 && cells.last_b - cells.first_b <= 1)
    return cells.for_each([&](int a, int b) { raise(a, b, whole); });
  const FlatTriangle triangle(p, q, r, lattice.step);
  cells.for_each([&](int a, int b) {
    const double u = lattice.u(a), v = lattice.v(b);
    if (triangle.misses(u, v)) return;
    const double plane = triangle.is_upright() ? top : triangle.top_over(u, v);
    raise(a, b, plane < top ? above(plane) : whole);
  });
}

void HeightMap::raise(const HeightMap& other) {
  for (std::size_t at = 0; at < heights.size(); ++at) heights[at] = std::max(heights[at], other.heights[at]);
}

namespace {

/// Raises a map by the cubes of voxels.
class CubeRaiser {
 public:
  CubeRaiser(const VoxelSet& standing, const Grid& grid, const ToolFrame& frame, const HeightMap* floor)
      : standing_(standing),
        grid_(grid),
        frame_(frame),
        floor_(floor),
        rows_(grid.n),
        steps_(steps_up(frame.direction)),
        half_(grid.voxel_m / 2 * frame.u.cwiseAbs().sum(), grid.voxel_m / 2 * frame.v.cwiseAbs().sum(),
              grid.voxel_m / 2 * frame.w.cwiseAbs().sum()) {}

  void raise_layer(HeightMap& map, int k) const {
    for (int j = 0; j < rows_.n; ++j)
      for (int chunk = 0; chunk < rows_.chunks; ++chunk)
        for (auto bits = upper_voxels(standing_, rows_, steps_, j, k, chunk); bits != 0; bits &= bits - 1)
          raise(map, {rows_.width * chunk + std::countr_zero(bits), j, k});
  }

 private:
  void raise(HeightMap& map, Voxel voxel) const {
    const Lattice& lattice = map.lattice;
    const Vec3 at = frame_.of(grid_.centre(voxel));
    if (floor_ != nullptr) {
      const int a = lattice.cell_u(at.x()), b = lattice.cell_v(at.y());
      if (lattice.contains(a, b) && at.z() < static_cast<double>(floor_->at(a, b))) return;
    }
    const float top = above(at.z() + half_.z());
    cells_over(lattice, at.x() - half_.x(), at.x() + half_.x(), at.y() - half_.y(), at.y() + half_.y())
        .for_each([&](int a, int b) { map.raise(a, b, top); });
  }

  const VoxelSet& standing_;
  const Grid& grid_;
  const ToolFrame& frame_;
  const HeightMap* floor_;
  VoxelRows rows_;
  std::vector<Voxel> steps_;
  Vec3 half_;  ///< of a cube's silhouette, along the frame's axes
};

}  // namespace

HeightMap heights_of(const VoxelSet& standing, const Grid& grid, const ToolFrame& frame, const Lattice& lattice,
                     const Helpers& helpers, const HeightMap* floor) {
  const CubeRaiser cubes(standing, grid, frame, floor);
  // Layers for each thread, and the higher of what they give.
  const int parts = std::min(grid.n, helpers.threads());
  std::vector<HeightMap> maps(static_cast<std::size_t>(parts), HeightMap(lattice));
  helpers.for_each_index(maps.size(), [&](std::size_t part) {
    const int number = static_cast<int>(part);
    for (int k = grid.n * number / parts; k < grid.n * (number + 1) / parts; ++k) cubes.raise_layer(maps[part], k);
  });
  for (std::size_t part = 1; part < maps.size(); ++part) maps[0].raise(maps[part]);
  return std::move(maps[0]);
}

}  // namespace sculpt
