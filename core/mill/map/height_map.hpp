// Heights over a lattice across the tool's axis: bounds for all of a cell, not samples.
#pragma once

#include <limits>
#include <vector>

#include "core/base/frame.hpp"
#include "core/base/helpers.hpp"
#include "core/material/voxel_set.hpp"
#include "core/mill/map/lattice.hpp"
#include "core/mill/map/tool_frame.hpp"

namespace sculpt {

inline constexpr float no_height = -std::numeric_limits<float>::infinity();

/// A lattice over a box of the stock frame, seen along the frame's axis, and `margin_m` around it.
Lattice lattice_over(const ToolFrame& frame, const Vec3& low, const Vec3& high, double margin_m, double step_m);

/// Of each cell a bound: for what stands, nothing in the cell's column is higher than this (m, along w).
struct HeightMap {
  explicit HeightMap(const Lattice& cells) : lattice(cells), heights(cells.size(), no_height) {}

  float at(int a, int b) const { return heights[lattice.index(a, b)]; }
  void raise(int a, int b, float to) {
    float& height = heights[lattice.index(a, b)];
    if (to > height) height = to;
  }

  /// A triangle, corners in coordinates of the tool's frame.
  void raise(const Vec3& p, const Vec3& q, const Vec3& r);
  /// The larger of the two, cell by cell; of the same lattice.
  void raise(const HeightMap& other);

  Lattice lattice;
  std::vector<float> heights;
};

/// The surface of standing voxels; each as the whole cube. `grid`: of `standing`. `floor`, if any: voxels whose centres
/// are lower than that do not count; of the same lattice.
HeightMap heights_of(const VoxelSet& standing, const Grid& grid, const ToolFrame& frame, const Lattice& lattice,
                     const Helpers& helpers, const HeightMap* floor = nullptr);

/// Calls `visit(a, b)` with all cells of the lattice that are nearer than `margin_m` to the segment, and perhaps with
/// some that are a little farther.
template <typename Visit>
void for_each_cell_near(const Lattice& lattice, const Vec3& from, const Vec3& to, double margin_m, const Visit& visit) {
  // A segment on the border of two rows is in both, however the borders are rounded.
  const double margin = margin_m + 1e-9;
  const double du = to.x() - from.x(), dv = to.y() - from.y();
  const int first_b = std::max(0, lattice.cell_v(std::min(from.y(), to.y()) - margin)),
            last_b = std::min(lattice.height - 1, lattice.cell_v(std::max(from.y(), to.y()) + margin));
  for (int b = first_b; b <= last_b; ++b) {
    // The part of the segment whose v is within the row and the margin.
    const double low_v = lattice.low_v + b * lattice.step - margin, high_v = low_v + lattice.step + 2 * margin;
    double begin = 0, end = 1;
    if (std::abs(dv) > 1e-12) {
      const double s = (low_v - from.y()) / dv, t = (high_v - from.y()) / dv;
      begin = std::max(begin, std::min(s, t));
      end = std::min(end, std::max(s, t));
    } else if (from.y() < low_v || from.y() > high_v) {
      continue;
    }
    if (begin > end) continue;
    const double u0 = from.x() + begin * du, u1 = from.x() + end * du;
    const int first_a = std::max(0, lattice.cell_u(std::min(u0, u1) - margin)),
              last_a = std::min(lattice.width - 1, lattice.cell_u(std::max(u0, u1) + margin));
    for (int a = first_a; a <= last_a; ++a) visit(a, b);
  }
}

}  // namespace sculpt
