#include "core/mill/piece_watch.hpp"

#include <algorithm>
#include <bit>

#include "core/material/loose_pieces.hpp"

namespace sculpt {

PieceWatch::PieceWatch(const VoxelGrid& voxels) : n_(voxels.n()), may_fall_(find_loose(voxels.stock)) {
  const VoxelSet unheld = find_unheld(voxels);
  for (std::size_t at = 0; at < unheld.words().size(); ++at) may_fall_.words()[at] |= unheld.words()[at];
}

template <class Visit>
void PieceWatch::for_each_beside(const VoxelSet& standing, std::size_t voxel, const Visit& visit) const {
  const auto n = static_cast<std::size_t>(n_), layer = n * n, i = voxel % n, j = voxel / n % n;
  const auto look = [&](std::size_t beside) {
    if ((standing.words()[beside >> 6] >> (beside & 63) & 1) != 0) visit(static_cast<std::uint32_t>(beside));
  };
  if (i > 0) look(voxel - 1);
  if (i + 1 < n) look(voxel + 1);
  if (j > 0) look(voxel - n);
  if (j + 1 < n) look(voxel + n);
  if (voxel >= layer) look(voxel - layer);
  if (voxel + layer < layer * n) look(voxel + layer);
}

bool PieceWatch::frees(const VoxelSet& standing, const SweptSet::Taken& taken, double chip_voxels) {
  fronts_.clear();
  spreads_.clear();
  next_.clear();
  table_.reset();
  open_ = 0;
  // What stood on the table may have held the rest: that it is there is known before a front comes to it.
  if (std::ranges::any_of(taken, [&](const auto& bits) { return is_on_table(64 * bits.first); }))
    table_ = begin_spread();
  for (const auto& [word, bits] : taken)
    for (std::uint64_t rest = bits; rest != 0; rest &= rest - 1)
      for_each_beside(standing, 64 * word + static_cast<std::size_t>(std::countr_zero(rest)), [&](std::uint32_t voxel) {
        const auto [front, is_new] = fronts_.enter(voxel);
        if (is_new) reach(voxel, front = begin_spread());
      });
  while (open_ > 1) {
    std::swap(now_, next_);
    next_.clear();
    for (const Step& step : now_) {
      for_each_beside(standing, step.voxel, [&](std::uint32_t voxel) {
        const auto [front, is_new] = fronts_.enter(voxel);
        if (is_new) {
          reach(voxel, front = step.front);
        } else {
          join(front, step.front);
        }
      });
      const Front all = root(step.front);
      if (--spreads_[all].waiting == 0 && !(table_ && root(*table_) == all)) {
        if (static_cast<double>(spreads_[all].counted) > chip_voxels) return true;
        --open_;
      }
      if (open_ <= 1) return false;
    }
  }
  return false;
}

PieceWatch::Front PieceWatch::begin_spread() {
  ++open_;
  spreads_.push_back({static_cast<Front>(spreads_.size())});
  return spreads_.back().parent;
}

void PieceWatch::reach(std::uint32_t voxel, Front front) {
  next_.push_back({voxel, front});
  Spread& spread = spreads_[root(front)];
  ++spread.waiting;
  spread.counted += (may_fall_.words()[voxel >> 6] >> (voxel & 63) & 1) == 0;
  if (!is_on_table(voxel)) return;
  if (table_) {
    join(*table_, front);
  } else {
    table_ = front;
  }
}

PieceWatch::Front PieceWatch::root(Front front) {
  while (spreads_[front].parent != front) front = spreads_[front].parent = spreads_[spreads_[front].parent].parent;
  return front;
}

void PieceWatch::join(Front a, Front b) {
  a = root(a);
  b = root(b);
  if (a == b) return;
  if (b < a) std::swap(a, b);
  Spread &into = spreads_[a], &from = spreads_[b];
  from.parent = a;
  into.waiting += from.waiting;
  into.counted += from.counted;
  --open_;
}

}  // namespace sculpt
