// The material that still stands, as an octomap tree that FCL can be asked about. Internal to verify/. Millimetres from
// the corner of voxel (0,0,0).
#pragma once

#include <fcl/fcl.h>

#include <memory>

#include "core/material/voxel_set.hpp"

namespace sculpt {

class StandingVoxels {
 public:
  StandingVoxels(const VoxelSet& standing, double voxel_mm);

  const VoxelSet& voxels() const { return voxels_; }
  double side_mm() const { return side_mm_; }
  bool contains(Voxel v) const { return voxels_.contains(v); }
  void remove(Voxel v);
  /// Undoes a removal.
  void put_back(Voxel v);
  /// `low`, `high`: any box that holds what the placed geometry stands for; where no voxel of that box stands, nothing
  /// else is asked.
  bool touches(const fcl::CollisionGeometryd& geometry, const Frame& pose, const Vec3& low, const Vec3& high) const;

 private:
  bool known_empty(const Vec3& low, const Vec3& high) const;

  VoxelSet voxels_;
  std::size_t count_;
  double voxel_mm_, side_mm_;
  std::shared_ptr<octomap::OcTree> tree_;
  std::unique_ptr<fcl::OcTreed> solid_;
};

}  // namespace sculpt
