// The material that still stands, and what touches it. Internal to verify/. Millimetres from the corner of voxel
// (0,0,0).
#pragma once

#include <fcl/fcl.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/large_pages.hpp"
#include "core/material/voxel_set.hpp"
#include "core/verify/material/material_tree.hpp"

namespace sculpt {

/// Bricks of 4 x 4 x 4 bits, each of which says whether anything stands in a brick of the level below. Convex shapes
/// are held against cubes in closed form, from the coarse to the fine; what that leaves open, and meshes, FCL decides.
class StandingVoxels {
 public:
  /// `thorough`: FCL decides all, on an octomap tree.
  StandingVoxels(const VoxelSet& standing, double voxel_mm, bool thorough);

  VoxelSet voxels() const;
  double voxel_mm() const { return voxel_mm_; }
  double side_mm() const { return side_mm_; }
  /// Nothing is to be left to anything but FCL.
  bool thorough() const { return thorough_; }
  bool contains(Voxel v) const {
    const Level& finest = levels_.front();
    return finest.words[finest.index(brick_of(v))] >> bit_of(v) & 1;
  }
  void remove(Voxel v);
  /// Undoes a removal.
  void put_back(Voxel v);
  /// `low`, `high`: any box that holds what the placed geometry stands for; where no voxel of that box stands, nothing
  /// else is asked.
  bool touches(const fcl::CollisionGeometryd& geometry, const Frame& pose, const Vec3& low, const Vec3& high) const;

 private:
  struct Level {
    std::size_t side;  ///< in bricks
    Words words;       ///< by brick; bit x + 4 y + 16 z

    std::size_t index(Voxel brick) const {
      return static_cast<std::size_t>(brick.i) +
             side * (static_cast<std::size_t>(brick.j) + side * static_cast<std::size_t>(brick.k));
    }
  };
  /// Of voxels, both ends included.
  struct Range {
    std::array<int, 3> first, last;
  };
  enum class Look { nothing, deeper, found };

  static Voxel brick_of(Voxel v) { return {v.i >> 2, v.j >> 2, v.k >> 2}; }
  static int bit_of(Voxel v) { return (v.i & 3) + 4 * (v.j & 3) + 16 * (v.k & 3); }

  Range range(const Vec3& low, const Vec3& high) const;
  template <typename Meets>
  bool find(const Range& range, const Meets& meets) const;
  template <typename Meets>
  bool find_in_brick(std::size_t level, Voxel brick, const Range& range, const Meets& meets) const;
  MaterialTree& tree() const;

  int n_;
  std::size_t count_;
  double voxel_mm_, side_mm_;
  bool thorough_;
  std::vector<Level> levels_;                   ///< the finest first
  mutable std::unique_ptr<MaterialTree> tree_;  ///< made when it is first asked
  mutable std::vector<Voxel> changed_;          ///< what it does not know yet
};

}  // namespace sculpt
