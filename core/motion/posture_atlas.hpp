// Whether the arm can hold the tool like this near there at all, and how: asked once for each part of the grid.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "core/cell/chain.hpp"
#include "core/material/voxel.hpp"

namespace sculpt {

/// Postures that bring the ball to the middle of each of 4^3 parts of the grid along each of the `tool_axes()`, as IK
/// from the middle of the joints' limits and from random configurations finds them. Links and material are not looked
/// at, so what it says depends on nothing but the cell and the seed. Found when first asked for; safe to use from
/// several threads.
class PostureAtlas {
 public:
  /// The chain must outlive the atlas.
  PostureAtlas(const Chain& chain, const Grid& grid, std::uint64_t seed);

  /// The `tool_axes()`.
  const std::vector<Vec3>& axes() const { return axes_; }

  /// Up to `most` of them that hold the tool along the axis of this number near the voxel: those of its part, then
  /// those of the parts around it. None: no part there is come to.
  std::vector<Configuration> around(Voxel voxel, std::size_t axis, std::size_t most) const;

  /// The same beyond the joints' limits, for where there is none within them.
  std::vector<Configuration> beyond_limits(Voxel voxel, std::size_t axis) const;

 private:
  struct Postures {
    std::vector<Configuration> within;
    std::vector<Configuration> beyond;  ///< where none is within the limits
  };
  struct Entry {
    std::once_flag once;
    Postures postures;
  };

  const Postures& at(Voxel part, std::size_t axis) const;
  Postures find(Voxel part, std::size_t axis) const;
  Voxel part_of(Voxel voxel) const;
  std::vector<Voxel> parts_by_distance(Voxel voxel) const;

  const Chain& chain_;
  Grid parts_;
  int voxels_a_part_;
  std::vector<Vec3> axes_;
  std::uint64_t seed_;
  std::unique_ptr<Entry[]> entries_;
};

}  // namespace sculpt
