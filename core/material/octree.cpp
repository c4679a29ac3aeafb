#include "core/material/octree.hpp"

#include <algorithm>

#include "core/material/voxel_rows.hpp"

namespace sculpt {
namespace {

enum class Cell : std::uint8_t { air, keep, remove, mixed };

/// Cells of 2, 4, 8... voxels an edge: levels[l] has (n >> (l + 1))^3 of them, i fastest.
using Pyramid = std::vector<std::vector<Cell>>;

Cell cell_of(bool any_stock, bool all_stock, bool any_keep, bool all_keep) {
  if (!any_stock) return Cell::air;
  if (all_keep) return Cell::keep;
  return all_stock && !any_keep ? Cell::remove : Cell::mixed;
}

/// Any and all of each pair of voxels along x, at the even bits, over the 2 x 2 rows from (j, k).
struct Pairs {
  std::uint64_t any = 0, all = ~std::uint64_t{0};
};
Pairs pairs_of(const VoxelSet& set, const VoxelRows& rows, int j, int k, int chunk) {
  Pairs pairs;
  for (int row = 0; row < 4; ++row) {
    const std::uint64_t bits = rows.get(set, j + (row & 1), k + (row >> 1), chunk);
    pairs.any |= bits;
    pairs.all &= bits;
  }
  return {pairs.any | (pairs.any >> 1), pairs.all & (pairs.all >> 1)};
}

std::vector<Cell> lowest_level(const VoxelGrid& voxels, const Watch& watch) {
  const int n = voxels.n();
  const VoxelRows rows(n);
  std::vector<Cell> cells;
  cells.reserve(static_cast<std::size_t>(n) * n * n / 8);
  for (int k = 0; k < n; k += 2) {
    watch.step(Stage::octree, k, n);
    for (int j = 0; j < n; j += 2) {
      for (int c = 0; c < rows.chunks; ++c) {
        const Pairs stock = pairs_of(voxels.stock, rows, j, k, c), keep = pairs_of(voxels.keep, rows, j, k, c);
        for (int bit = 0; bit < rows.width; bit += 2)
          cells.push_back(
              cell_of((stock.any >> bit) & 1, (stock.all >> bit) & 1, (keep.any >> bit) & 1, (keep.all >> bit) & 1));
      }
    }
  }
  return cells;
}

std::vector<Cell> level_above(const std::vector<Cell>& below, int edge_below) {
  const std::size_t edge = static_cast<std::size_t>(edge_below) / 2, row = 2 * edge, layer = row * row;
  std::vector<Cell> cells;
  cells.reserve(edge * edge * edge);
  for (std::size_t k = 0; k < edge; ++k) {
    for (std::size_t j = 0; j < edge; ++j) {
      for (std::size_t i = 0; i < edge; ++i) {
        const Cell* first = below.data() + 2 * (i + row * j + layer * k);
        bool same = true;
        for (std::size_t child = 1; child < 8; ++child)
          same &= first[(child & 1) + row * ((child >> 1) & 1) + layer * (child >> 2)] == *first;
        cells.push_back(same ? *first : Cell::mixed);
      }
    }
  }
  return cells;
}

/// Walks the mixed cells in Morton order.
class Emitter {
 public:
  Emitter(const VoxelGrid& voxels, const Pyramid& pyramid, std::vector<Block>& leaves)
      : voxels_(voxels), pyramid_(pyramid), leaves_(leaves) {}

  void emit(Voxel corner, int size, int level) {
    if (level < 0) {
      leaves_.push_back({corner, 1, voxels_.label(corner)});
      return;
    }
    const std::size_t edge = static_cast<std::size_t>(voxels_.n() / size);
    const Cell cell = pyramid_[level][corner.i / size + edge * (corner.j / size + edge * (corner.k / size))];
    if (cell != Cell::mixed) {
      leaves_.push_back({corner, size, static_cast<Label>(cell)});
      return;
    }
    const int half = size / 2;
    for (int child = 0; child < 8; ++child)
      emit(corner + Voxel{child & 1, (child >> 1) & 1, child >> 2} * half, half, level - 1);
  }

 private:
  const VoxelGrid& voxels_;
  const Pyramid& pyramid_;
  std::vector<Block>& leaves_;
};

bool top_bit_below(unsigned a, unsigned b) {
  return a < b && a < (a ^ b);
}

/// Compares Morton codes (k above j above i) without making them (Chan, SODA 2002).
bool morton_less(Voxel a, Voxel b) {
  const unsigned di = a.i ^ b.i, dj = a.j ^ b.j, dk = a.k ^ b.k;
  if (!top_bit_below(dk, dj) && !top_bit_below(dk, di)) return a.k < b.k;
  return top_bit_below(dj, di) ? a.i < b.i : a.j < b.j;
}

}  // namespace

int Octree::find(Voxel v) const {
  const auto after = std::upper_bound(leaves.begin(), leaves.end(), v,
                                      [](Voxel at, const Block& leaf) { return morton_less(at, leaf.corner); });
  return static_cast<int>(after - leaves.begin()) - 1;
}

Octree build_octree(const VoxelGrid& voxels, const Watch& watch) {
  Octree octree{voxels.n(), {}};
  Pyramid pyramid{lowest_level(voxels, watch)};
  for (int edge = voxels.n() / 2; edge > 1; edge /= 2) pyramid.push_back(level_above(pyramid.back(), edge));
  Emitter(voxels, pyramid, octree.leaves).emit({0, 0, 0}, voxels.n(), static_cast<int>(pyramid.size()) - 1);
  watch.step(Stage::octree, voxels.n(), voxels.n());
  return octree;
}

}  // namespace sculpt
