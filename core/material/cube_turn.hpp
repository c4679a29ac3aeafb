// A grid turned onto itself: how a block is clamped another time.
#pragma once

#include <array>
#include <optional>

#include "core/material/voxel_set.hpp"

namespace sculpt {

/// Turns of a cube onto itself.
struct CubeTurn {
  std::array<Voxel, 3> axes;  ///< where x, y and z come to lie
  bool operator==(const CubeTurn&) const = default;

  /// About the middle of an n^3 grid.
  Voxel of(Voxel v, int n) const;
  VoxelSet of(const VoxelSet& set) const;
};
inline constexpr CubeTurn no_turn{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};

/// Roll, pitch and yaw (rad) about the fixed x, y, z axes, as a mesh is turned by its placement; nothing unless all
/// three are whole quarter turns, to a millionth of one.
std::optional<CubeTurn> cube_turn(const Vec3& rotation_rad);

/// Down by so many layers; what would leave the grid is gone.
VoxelSet lowered(const VoxelSet& set, int layers);
/// The lowest layer that has a voxel; 0 if there is none.
int lowest_layer(const VoxelSet& set);

}  // namespace sculpt
