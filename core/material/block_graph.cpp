#include "core/material/block_graph.hpp"

#include <algorithm>
#include <bit>

namespace sculpt {
namespace {

constexpr std::uint32_t none = ~std::uint32_t{0};

/// Puts two zero bits between the bits of a coordinate below 2^21.
std::uint64_t spread3(std::uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffffull;
  x = (x | x << 16) & 0x1f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  return (x | x << 2) & 0x1249249249249249ull;
}

std::uint64_t morton(Voxel v) {
  return spread3(static_cast<unsigned>(v.i)) | spread3(static_cast<unsigned>(v.j)) << 1 |
         spread3(static_cast<unsigned>(v.k)) << 2;
}

/// Finds leaves in near constant time: a table of coarse cells bounds the search to a few leaves.
class LeafIndex {
 public:
  explicit LeafIndex(const Octree& octree) {
    codes_.reserve(octree.leaves.size());
    for (const Block& leaf : octree.leaves) codes_.push_back(morton(leaf.corner));
    const int level = std::countr_zero(static_cast<unsigned>(octree.n));
    shift_ = 3 * std::max(level - 6, 1);
    first_.resize((std::size_t{1} << (3 * level - shift_)) + 1);
    std::size_t leaf = 0;
    for (std::size_t cell = 0; cell < first_.size(); ++cell) {
      while (leaf < codes_.size() && (codes_[leaf] >> shift_) < cell) ++leaf;
      first_[cell] = static_cast<std::uint32_t>(leaf);
    }
  }
  std::uint32_t find(Voxel v) const {
    const std::uint64_t code = morton(v), cell = code >> shift_;
    const auto after = std::upper_bound(codes_.begin() + first_[cell], codes_.begin() + first_[cell + 1], code);
    return static_cast<std::uint32_t>(after - codes_.begin()) - 1;
  }

 private:
  std::vector<std::uint64_t> codes_;
  std::vector<std::uint32_t> first_;  ///< first leaf whose corner is in the coarse cell or behind it
  int shift_ = 0;
};

/// The leaf at the far side of each face, where it is at least as large: then it holds the whole face.
std::vector<std::array<std::uint32_t, 6>> larger_neighbours(const Octree& octree, const Watch& watch) {
  const LeafIndex index(octree);
  std::vector<std::array<std::uint32_t, 6>> found(octree.leaves.size());
  for (std::size_t at = 0; at < found.size(); ++at) {
    if (at % 4096 == 0) watch.step(Stage::octree, at, found.size());
    const Block& leaf = octree.leaves[at];
    for (std::size_t face = 0; face < 6; ++face) {
      const bool up = face % 2 == 1;
      const Voxel across = leaf.corner + face_steps[face] * (up ? leaf.size : 1);
      const bool outside =
          std::min({across.i, across.j, across.k}) < 0 || std::max({across.i, across.j, across.k}) >= octree.n;
      found[at][face] = outside ? none : index.find(across);
      if (!outside && octree.leaves[found[at][face]].size < leaf.size) found[at][face] = none;
    }
  }
  return found;
}

}  // namespace

BlockGraph build_block_graph(const Octree& octree, const Watch& watch) {
  const auto found = larger_neighbours(octree, watch);
  const std::size_t count = octree.leaves.size();
  // A smaller leaf names its larger neighbour for both; leaves of one size name each other.
  const auto for_each_edge = [&](const auto& edge) {
    for (std::uint32_t leaf = 0; leaf < count; ++leaf) {
      for (std::uint32_t other : found[leaf]) {
        if (other == none) continue;
        edge(leaf, other);
        if (octree.leaves[other].size > octree.leaves[leaf].size) edge(other, leaf);
      }
    }
  };
  BlockGraph graph;
  graph.first.assign(count + 1, 0);
  for_each_edge([&](std::uint32_t from, std::uint32_t) { ++graph.first[from + 1]; });
  for (std::size_t leaf = 0; leaf < count; ++leaf) graph.first[leaf + 1] += graph.first[leaf];
  graph.neighbours.resize(graph.first[count]);
  std::vector<std::uint32_t> next(graph.first.begin(), graph.first.end() - 1);
  for_each_edge([&](std::uint32_t from, std::uint32_t to) { graph.neighbours[next[from]++] = to; });
  for (std::size_t leaf = 0; leaf < count; ++leaf)
    std::sort(graph.neighbours.begin() + graph.first[leaf], graph.neighbours.begin() + graph.first[leaf + 1]);
  return graph;
}

}  // namespace sculpt
