// Standing voxels as an octomap tree that FCL can be asked about. Internal to verify/. Millimetres from the corner of
// voxel (0,0,0).
#pragma once

#include <fcl/fcl.h>

#include <memory>

#include "core/material/voxel_set.hpp"

namespace sculpt {

class MaterialTree {
 public:
  MaterialTree(const VoxelSet& standing, double voxel_mm);

  void set(Voxel v, bool stands);
  /// Something must stand.
  bool touches(const fcl::CollisionGeometryd& geometry, const Frame& pose) const;

 private:
  std::shared_ptr<octomap::OcTree> tree_;
  fcl::OcTreed solid_;
};

}  // namespace sculpt
