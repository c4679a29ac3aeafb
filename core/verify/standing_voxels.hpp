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
  /// `low`, `high`: any box around the placed geometry; it spares most calls the walk through the tree.
  bool touches(const fcl::CollisionGeometryd& geometry, const Frame& pose, const Vec3& low, const Vec3& high) const;

 private:
  VoxelSet voxels_;
  std::size_t count_;
  double side_mm_;
  std::shared_ptr<octomap::OcTree> tree_;
  std::unique_ptr<fcl::OcTreed> solid_;
};

}  // namespace sculpt
