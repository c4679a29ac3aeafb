// What still stands, and whether a tool or a box of space meets it. Lengths in voxel edges, origin at the corner of
// voxel (0,0,0).
#pragma once

#include <algorithm>
#include <bit>
#include <optional>
#include <vector>

#include "core/collision/shape/distance.hpp"
#include "core/material/voxel_set.hpp"

namespace sculpt {

/// Voxels that a tool may touch: none, one, or a straight run.
class Exempt {
 public:
  Exempt() = default;
  Exempt(std::optional<Voxel> voxel) {
    if (voxel) low_ = high_ = *voxel;
  }
  Exempt(Voxel voxel) : Exempt(VoxelLine{voxel, voxel}) {}
  Exempt(const VoxelLine& run)
      : low_{std::min(run.first.i, run.last.i), std::min(run.first.j, run.last.j), std::min(run.first.k, run.last.k)},
        high_{std::max(run.first.i, run.last.i), std::max(run.first.j, run.last.j), std::max(run.first.k, run.last.k)} {
  }

  bool contains(Voxel v) const { return meets(v, 1); }
  /// Are any of them in the cube of `size` voxels an edge at `corner`?
  bool meets(Voxel corner, int size) const {
    return low_.i < corner.i + size && high_.i >= corner.i && low_.j < corner.j + size && high_.j >= corner.j &&
           low_.k < corner.k + size && high_.k >= corner.k;
  }

 private:
  Voxel low_{0, 0, 0}, high_{-1, -1, -1};
};

/// The standing voxels with counts per aligned cube of 2, 4, 8... voxels, so that full cubes (blocks) and empty space
/// are found at once. Reads from several threads are safe, `remove` is not.
class Material {
 public:
  explicit Material(const VoxelSet& standing);

  int n() const { return solid_.n(); }
  const VoxelSet& solid() const { return solid_; }
  /// False outside the grid.
  bool contains(Voxel v) const {
    return v.i >= 0 && v.j >= 0 && v.k >= 0 && v.i < n() && v.j < n() && v.k < n() && solid_.contains(v);
  }
  void remove(Voxel v);

  /// Of the aligned cube of `size` (a power of two) voxels along each edge, does all stand, does any?
  bool is_full(Voxel corner, int size) const { return count_in(corner, size) == volume(level_of(size)); }
  bool any_in(Voxel corner, int size) const { return count_in(corner, size) > 0; }

  /// Does the capsule of `radius` around `segment` come closer than 0 to a standing voxel other than `exempt`? Exact.
  bool meets_capsule(const Segment& segment, double radius, const Exempt& exempt) const;

 private:
  bool meets_thin_capsule(const Segment& segment, double radius, const Exempt& exempt) const;
  /// Of the voxels whose coordinate along axis `main` is `slab`.
  bool slab_meets_capsule(int main, int slab, const Segment& segment, double radius, const Exempt& exempt) const;
  bool cube_meets_capsule(int level, Voxel at, const Segment& segment, double radius, const Exempt& exempt) const;

  static int level_of(int size) { return std::countr_zero(static_cast<unsigned>(size)); }
  std::uint32_t count_in(Voxel corner, int size) const {
    return count(level_of(size), {corner.i / size, corner.j / size, corner.k / size});
  }
  static std::uint32_t volume(int level) { return std::uint32_t{1} << (3 * level); }
  /// Standing voxels in the cube of edge 2^level at position `at` among cubes of that size.
  std::uint32_t count(int level, Voxel at) const {
    if (level == 0) return solid_.contains(at) ? 1 : 0;
    if (level < lowest_kept) return count_eight(at * 2);
    const std::size_t m = static_cast<std::size_t>(n() >> level);
    return counts_[static_cast<std::size_t>(level - lowest_kept)]
                  [static_cast<std::size_t>(at.i) +
                   m * (static_cast<std::size_t>(at.j) + m * static_cast<std::size_t>(at.k))];
  }
  /// Standing voxels in the cube of 2 voxels an edge at `corner`.
  std::uint32_t count_eight(Voxel corner) const {
    std::uint32_t sum = 0;
    for (int row = 0; row < 4; ++row) {
      const std::size_t at = solid_.index(corner + Voxel{0, row & 1, row >> 1});
      sum += static_cast<std::uint32_t>(std::popcount(solid_.words()[at >> 6] >> (at & 63) & 3));
    }
    return sum;
  }

  static constexpr int lowest_kept = 2;  ///< below it voxels are counted as quickly as a count is read

  VoxelSet solid_;
  /// [level - lowest_kept]: standing voxels per aligned cube of edge 2^level.
  std::vector<std::vector<std::uint32_t, LargePages<std::uint32_t>>> counts_;
};

}  // namespace sculpt
