#include "core/material/cavities.hpp"

#include <deque>

#include "core/material/voxel_rows.hpp"

namespace sculpt {
namespace {

/// Spreads `seeds` along the runs of `open` bits that hold them, within one word.
std::uint64_t spread(std::uint64_t seeds, std::uint64_t open) {
  std::uint64_t up = seeds & open, up_open = open, down = up, down_open = open;
  for (int shift = 1; shift < 64; shift *= 2) {
    up |= up_open & (up << shift);
    up_open &= up_open << shift;
    down |= down_open & (down >> shift);
    down_open &= down_open >> shift;
  }
  return up | down;
}

/// Flood through everything but `keep`, a row at a time; a row is looked at again when a neighbour row grew.
class Flood {
 public:
  explicit Flood(const VoxelSet& keep)
      : n_(keep.n()), rows_(n_), keep_(keep), reached_(n_), waiting_(static_cast<std::size_t>(n_) * n_, true) {
    for (int row = n_ * n_ - 1; row >= 0; --row) queue_.push_back(row);  // from above: where most of the outside is
  }

  VoxelSet run() {
    while (!queue_.empty()) {
      const int row = queue_.front();
      queue_.pop_front();
      waiting_[row] = false;
      if (!grow(row % n_, row / n_)) continue;
      for (Voxel step : {Voxel{0, -1, 0}, Voxel{0, 1, 0}, Voxel{0, 0, -1}, Voxel{0, 0, 1}})
        wake(row % n_ + step.j, row / n_ + step.k);
    }
    return std::move(reached_);
  }

 private:
  void wake(int j, int k) {
    if (j < 0 || k < 0 || j >= n_ || k >= n_ || waiting_[j + n_ * k]) return;
    waiting_[j + n_ * k] = true;
    queue_.push_back(j + n_ * k);
  }

  /// What the row beside lets in: all of the outside at the sides and above, nothing below the floor.
  std::uint64_t beside(int j, int k, int chunk) const {
    if (k < 0) return 0;
    if (j < 0 || j >= n_ || k >= n_) return rows_.mask();
    return rows_.get(reached_, j, k, chunk);
  }

  bool grow(int j, int k) {
    bool grew = false;
    std::uint64_t carry = 1;  // the outside at i = -1
    for (int c = 0; c < rows_.chunks; ++c) {
      const std::uint64_t seeds = beside(j - 1, k, c) | beside(j + 1, k, c) | beside(j, k - 1, c) | beside(j, k + 1, c);
      grew |= grow_chunk(j, k, c, seeds | carry);
      carry = (rows_.get(reached_, j, k, c) >> (rows_.width - 1)) & 1;
    }
    carry = 1;
    for (int c = rows_.chunks - 1; c >= 0; --c) {
      grew |= grow_chunk(j, k, c, carry << (rows_.width - 1));
      carry = rows_.get(reached_, j, k, c) & 1;
    }
    return grew;
  }

  bool grow_chunk(int j, int k, int chunk, std::uint64_t seeds) {
    const std::uint64_t before = rows_.get(reached_, j, k, chunk);
    const std::uint64_t open = ~rows_.get(keep_, j, k, chunk) & rows_.mask();
    const std::uint64_t after = spread(before | seeds, open);
    if (after == before) return false;
    rows_.put(reached_, j, k, chunk, after);
    return true;
  }

  int n_;
  VoxelRows rows_;
  const VoxelSet& keep_;
  VoxelSet reached_;
  std::vector<bool> waiting_;
  std::deque<int> queue_;
};

}  // namespace

VoxelSet find_enclosed(const VoxelGrid& voxels) {
  VoxelSet enclosed = Flood(voxels.keep).run();
  for (std::size_t at = 0; at < enclosed.words().size(); ++at)
    enclosed.words()[at] = voxels.stock.words()[at] & ~voxels.keep.words()[at] & ~enclosed.words()[at];
  return enclosed;
}

}  // namespace sculpt
