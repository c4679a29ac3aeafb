#include "core/verify/standing_voxels.hpp"

#include "core/verify/solid_body.hpp"

namespace sculpt {
namespace {

// The tree's keys 32768 and up are its positive octant, so the material lies in one octant and its corner at 0.
octomap::OcTreeKey key_of(Voxel v) {
  constexpr int middle = 32768;
  return {static_cast<octomap::key_type>(middle + v.i), static_cast<octomap::key_type>(middle + v.j),
          static_cast<octomap::key_type>(middle + v.k)};
}

}  // namespace

StandingVoxels::StandingVoxels(const VoxelSet& standing, double voxel_mm)
    : voxels_(standing),
      count_(standing.size()),
      side_mm_(standing.n() * voxel_mm),
      tree_(std::make_shared<octomap::OcTree>(voxel_mm)) {
  const int n = standing.n();
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        if (voxels_.contains({i, j, k})) tree_->setNodeValue(key_of({i, j, k}), tree_->getClampingThresMaxLog(), true);
  tree_->updateInnerOccupancy();
  tree_->prune();
  solid_ = std::make_unique<fcl::OcTreed>(tree_);
}

// The node becomes a free one and merges with free neighbours. (octomap 1.9's deleteNode leaves empty child arrays
// behind, and a root without children would count as one huge occupied leaf.)
void StandingVoxels::remove(Voxel v) {
  if (!voxels_.contains(v)) return;
  voxels_.erase(v);
  --count_;
  tree_->setNodeValue(key_of(v), tree_->getClampingThresMinLog(), false);
}

bool StandingVoxels::touches(const fcl::CollisionGeometryd& geometry, const Frame& pose, const Vec3& low,
                             const Vec3& high) const {
  if (count_ == 0 || (high.array() < 0).any() || (low.array() > side_mm_).any()) return false;
  return solids_touch(*solid_, Frame::Identity(), geometry, pose);
}

}  // namespace sculpt
