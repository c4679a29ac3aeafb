// Which voxels are near a parallelogram, such as the axis of a cutter goes over. Internal to verify/. Quanta of 1e-7 m.
//
// What is near it has its shadow near that of the parallelogram, seen along each of the three axes of the grid:
//
//        y                 z                 z
//        |   ___           |  ____           |   __
//        |  /  /           | /   /           |  / /       of a row (one j, one k) what the first two leave,
//        | /__/            |/___/            | /_/        if the third leaves it at all
//        +------ x         +------ x         +------ y
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/base/frame.hpp"
#include "core/material/voxel_set.hpp"

namespace sculpt {

using Quanta3 = std::array<std::int64_t, 3>;
inline constexpr double quanta_per_metre = 1e7;

/// A grid's voxels whose centres may be no farther than `reach` from a parallelogram. Immutable.
class NearVoxels {
 public:
  /// `corner`: one of its corners; `way`, `up`: its edges from there. `reach`: in quanta.
  NearVoxels(const Grid& grid, const Quanta3& corner, const Quanta3& way, const Vec3& up, double reach);

  /// Calls `visit(first, last, j, k)` with runs of voxels along x that together hold all that are so near.
  template <typename Visit>
  void for_each_row(const Visit& visit) const {
    const Range all_j = numbers(1, extent(1)), all_k = numbers(2, extent(2));
    std::vector<Range> along_j;
    for (std::int64_t j = all_j[0]; j <= all_j[1]; ++j) along_j.push_back(numbers(0, shadow(0, 1, j)));
    for (std::int64_t k = all_k[0]; k <= all_k[1]; ++k) {
      const Range along_k = numbers(0, shadow(0, 2, k)), rows = both(all_j, numbers(1, shadow(1, 2, k)));
      for (std::int64_t j = rows[0]; j <= rows[1]; ++j)
        if (const auto [first, last] = both(along_k, along_j[static_cast<std::size_t>(j - all_j[0])]); first <= last)
          visit(first, last, j, k);
    }
  }

  /// Where the centre of a voxel is along an axis, from the corner.
  std::int64_t from_corner(std::size_t axis, std::int64_t voxel) const {
    return origin_[axis] - corner_[axis] + ((2 * voxel + 1) * size_ + n_) / (2 * n_);
  }

 private:
  using Range = std::array<std::int64_t, 2>;

  static Range both(const Range& a, const Range& b) { return {std::max(a[0], b[0]), std::min(a[1], b[1])}; }
  std::array<double, 2> extent(std::size_t axis) const;
  std::array<double, 2> shadow(std::size_t axis, std::size_t other, std::int64_t voxel) const;
  Range numbers(std::size_t axis, const std::array<double, 2>& range) const;

  std::int64_t n_, size_;
  Quanta3 origin_{}, corner_;
  std::array<Vec3, 4> corners_;  ///< from the first one, one after the other
  double reach_;
};

}  // namespace sculpt
