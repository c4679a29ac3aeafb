#include "core/verify/standing_voxels.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/verify/robot/solid_body.hpp"

namespace sculpt {
namespace {

// Nothing as near to a voxel as this counts as clear of it.
constexpr double edge_mm = 1e-6;
constexpr int max_rows = 4096;

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

StandingVoxels::StandingVoxels(const VoxelSet& standing, double voxel_mm)
    : voxels_(standing),
      count_(standing.size()),
      voxel_mm_(voxel_mm),
      side_mm_(standing.n() * voxel_mm),
      tree_(std::make_shared<BlockTree>(standing, voxel_mm)),
      solid_(std::make_unique<fcl::OcTreed>(tree_)) {}

// The node becomes a free one and merges with free neighbours. (octomap 1.9's deleteNode leaves empty child arrays
// behind, and a root without children would count as one huge occupied leaf.)
void StandingVoxels::remove(Voxel v) {
  if (!voxels_.contains(v)) return;
  voxels_.erase(v);
  --count_;
  tree_->setNodeValue(key_of(v), tree_->getClampingThresMinLog(), false);
}

void StandingVoxels::put_back(Voxel v) {
  if (voxels_.contains(v)) return;
  voxels_.insert(v);
  ++count_;
  tree_->setNodeValue(key_of(v), tree_->getClampingThresMaxLog(), false);
}

// Looks at the bits of all voxels that the box touches, row by row. False also where that would take longer than the
// walk through the tree.
bool StandingVoxels::known_empty(const Vec3& low, const Vec3& high) const {
  const int n = voxels_.n();
  std::array<int, 3> first, last;
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<std::size_t>(axis);
    // In doubles: a joint that is far out gives numbers that no integer holds.
    first[at] = static_cast<int>(std::clamp(std::floor((low[axis] - edge_mm) / voxel_mm_), 0.0, n - 1.0));
    last[at] = static_cast<int>(std::clamp(std::floor((high[axis] + edge_mm) / voxel_mm_), 0.0, n - 1.0));
  }
  if ((last[1] - first[1] + 1) * (last[2] - first[2] + 1) > max_rows) return false;
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j) {
      const std::size_t begin = voxels_.index({first[0], j, k}), end = voxels_.index({last[0], j, k});
      for (std::size_t word = begin >> 6; word <= end >> 6; ++word) {
        std::uint64_t bits = voxels_.words()[word];
        if (word == begin >> 6) bits &= ~std::uint64_t{0} << (begin & 63);
        if (word == end >> 6) bits &= ~std::uint64_t{0} >> (63 - (end & 63));
        if (bits != 0) return false;
      }
    }
  return true;
}

bool StandingVoxels::touches(const fcl::CollisionGeometryd& geometry, const Frame& pose, const Vec3& low,
                             const Vec3& high) const {
  if (count_ == 0 || (high.array() < 0).any() || (low.array() > side_mm_).any()) return false;
  if (known_empty(low, high)) return false;
  return solids_touch(*solid_, Frame::Identity(), geometry, pose);
}

}  // namespace sculpt
