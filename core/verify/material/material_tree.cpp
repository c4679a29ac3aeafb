#include "core/verify/material/material_tree.hpp"

#include "core/verify/robot/solid_body.hpp"

namespace sculpt {
namespace {

// The tree's keys 32768 and up are its positive octant, so the material lies in one octant and its corner at 0.
octomap::OcTreeKey key_of(Voxel v) {
  constexpr int middle = 32768;
  return {static_cast<octomap::key_type>(middle + v.i), static_cast<octomap::key_type>(middle + v.j),
          static_cast<octomap::key_type>(middle + v.k)};
}

// Full, empty or mixed: is every voxel of the cube like its first one?
bool uniform(const VoxelSet& voxels, Voxel corner, int side) {
  const bool first = voxels.contains(corner);
  for (int k = 0; k < side; ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i)
        if (voxels.contains(corner + Voxel{i, j, k}) != first) return false;
  return true;
}

// Built from the root: setting voxel by voxel would first make a node of every one.
class BlockTree : public octomap::OcTree {
 public:
  BlockTree(const VoxelSet& voxels, double voxel_mm) : octomap::OcTree(voxel_mm) {
    if (voxels.size() == 0) return;
    root = new octomap::OcTreeNode;
    ++tree_size;
    size_changed = true;
    root->setLogOdds(getClampingThresMaxLog());
    // The first octant holds the material, at the corner towards the middle.
    octomap::OcTreeNode* node = add_child(root, 7);
    int side = 32768;
    for (; side > voxels.n(); side /= 2) node = add_child(node, 0);
    fill(node, voxels, {0, 0, 0}, side);
  }

 private:
  octomap::OcTreeNode* add_child(octomap::OcTreeNode* node, unsigned int index) {
    octomap::OcTreeNode* child = createNodeChild(node, index);
    child->setLogOdds(getClampingThresMaxLog());
    return child;
  }

  void fill(octomap::OcTreeNode* node, const VoxelSet& voxels, Voxel corner, int side) {
    if (uniform(voxels, corner, side)) return;
    const int half = side / 2;
    for (int index = 0; index < 8; ++index) {
      const Voxel at = corner + Voxel{index & 1, index >> 1 & 1, index >> 2 & 1} * half;
      if (!voxels.contains(at) && uniform(voxels, at, half)) continue;
      fill(add_child(node, static_cast<unsigned int>(index)), voxels, at, half);
    }
  }
};

}  // namespace

MaterialTree::MaterialTree(const VoxelSet& standing, double voxel_mm)
    : tree_(std::make_shared<BlockTree>(standing, voxel_mm)), solid_(tree_) {}

// A node that stands no longer becomes a free one and merges with free neighbours. (octomap 1.9's deleteNode leaves
// empty child arrays behind, and a root without children would count as one huge occupied leaf.)
void MaterialTree::set(Voxel v, bool stands) {
  tree_->setNodeValue(key_of(v), stands ? tree_->getClampingThresMaxLog() : tree_->getClampingThresMinLog(), false);
}

bool MaterialTree::touches(const fcl::CollisionGeometryd& geometry, const Frame& pose) const {
  return solids_touch(solid_, Frame::Identity(), geometry, pose);
}

}  // namespace sculpt
