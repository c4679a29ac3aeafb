#include "core/material/flood.hpp"

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

/// A row is looked at again when a neighbour row grew.
class Flood {
 public:
  Flood(const VoxelSet& open, FloodFrom entrance)
      : n_(open.n()),
        rows_(n_),
        open_(open),
        from_floor_(entrance == FloodFrom::floor),
        reached_(n_),
        waiting_(static_cast<std::size_t>(n_) * n_, true) {
    const int rows = n_ * n_;  // first those where most of the entrance is
    for (int at = 0; at < rows; ++at) queue_.push_back(from_floor_ ? at : rows - 1 - at);
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

  /// What the row beside lets in.
  std::uint64_t beside(int j, int k, int chunk) const {
    if (k < 0) return from_floor_ ? rows_.mask() : 0;
    if (j < 0 || j >= n_ || k >= n_) return from_floor_ ? 0 : rows_.mask();
    return rows_.get(reached_, j, k, chunk);
  }

  bool grow(int j, int k) {
    bool grew = false;
    const std::uint64_t outside = from_floor_ ? 0 : 1;  // before the first and behind the last voxel of the row
    std::uint64_t carry = outside;
    for (int c = 0; c < rows_.chunks; ++c) {
      const std::uint64_t seeds = beside(j - 1, k, c) | beside(j + 1, k, c) | beside(j, k - 1, c) | beside(j, k + 1, c);
      grew |= grow_chunk(j, k, c, seeds | carry);
      carry = (rows_.get(reached_, j, k, c) >> (rows_.width - 1)) & 1;
    }
    carry = outside;
    for (int c = rows_.chunks - 1; c >= 0; --c) {
      grew |= grow_chunk(j, k, c, carry << (rows_.width - 1));
      carry = rows_.get(reached_, j, k, c) & 1;
    }
    return grew;
  }

  bool grow_chunk(int j, int k, int chunk, std::uint64_t seeds) {
    const std::uint64_t before = rows_.get(reached_, j, k, chunk);
    const std::uint64_t after = spread(before | seeds, rows_.get(open_, j, k, chunk));
    if (after == before) return false;
    rows_.put(reached_, j, k, chunk, after);
    return true;
  }

  int n_;
  VoxelRows rows_;
  const VoxelSet& open_;
  bool from_floor_;
  VoxelSet reached_;
  std::vector<bool> waiting_;
  std::deque<int> queue_;
};

}  // namespace

VoxelSet flood(const VoxelSet& open, FloodFrom entrance) {
  return Flood(open, entrance).run();
}

}  // namespace sculpt
