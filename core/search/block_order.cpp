#include "core/search/block_order.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace sculpt {
namespace {

constexpr std::size_t max_foreseen = 256;

bool touches_outside(const Block& block, int n) {
  const auto at_side = [&](int low) { return low == 0 || low + block.size == n; };
  return at_side(block.corner.i) || at_side(block.corner.j) || block.corner.k + block.size == n;
}

class Order {
 public:
  Order(const Octree& octree, const BlockGraph& graph, Voxel start) : octree_(octree), graph_(graph), at_(start) {
    const std::size_t count = octree.leaves.size();
    left_.resize(count, 0);
    for (std::size_t b = 0; b < count; ++b) {
      const Block& block = octree.leaves[b];
      if (block.label == Label::remove) left_[b] = static_cast<std::uint64_t>(block.size) * block.size * block.size;
      total_ += left_[b];
    }
    for (std::size_t b = 0; b < count; ++b)
      if (left_[b] > 0 && has_open_face(static_cast<int>(b))) open_.insert(static_cast<int>(b));
  }

  void run(int max_effort, const TryBlock& try_block, const Watch& watch, const Foresee& foresee) {
    int effort = 0;
    std::uint64_t done_at_pass = 0;
    while (true) {
      while (!open_.empty()) {
        watch.step(Stage::plan, done_, total_);
        if (ready_.empty()) choose_ready(foresee, effort);
        try_one(try_block, effort);
      }
      if (aside_.empty()) return;
      if (done_ == done_at_pass && ++effort > max_effort) return;
      done_at_pass = done_;
      open_.swap(aside_);
    }
  }

 private:
  bool has_open_face(int block) const {
    if (touches_outside(octree_.leaves[static_cast<std::size_t>(block)], octree_.n)) return true;
    const auto near = graph_.of(block);
    return std::any_of(near.begin(), near.end(),
                       [&](std::uint32_t b) { return octree_.leaves[b].label != Label::keep && left_[b] < volume(b); });
  }

  std::uint64_t volume(std::uint32_t b) const {
    const Block& block = octree_.leaves[b];
    return block.label == Label::air ? 1 : static_cast<std::uint64_t>(block.size) * block.size * block.size;
  }

  /// Of those that are open the one with the least cost, then of the lowest number; they stay as they are until
  /// something is removed. As many as were tried in vain: that it goes on like this is likely then.
  void choose_ready(const Foresee& foresee, int effort) {
    if (next_.empty()) {
      for (const int b : open_) {
        const auto at = static_cast<std::size_t>(b);
        next_.emplace_back(static_cast<std::int64_t>(total_ - done_ - left_[at]) + octree_.leaves[at].distance(at_), b);
      }
      std::ranges::make_heap(next_, std::ranges::greater{});
    }
    const std::size_t count = std::min(next_.size(), std::clamp<std::size_t>(in_vain_, 1, max_foreseen));
    while (ready_.size() < count) {
      std::ranges::pop_heap(next_, std::ranges::greater{});
      ready_.push_back(next_.back().second);
      next_.pop_back();
    }
    std::ranges::reverse(ready_);
    if (foresee && count > 1) foresee(ready_, effort);
  }

  void try_one(const TryBlock& try_block, int effort) {
    const int block = ready_.back();
    ready_.pop_back();
    open_.erase(block);
    const BlockTrial trial = try_block(block, effort);
    if (trial.left > 0) aside_.insert(block);
    ++in_vain_;
    if (trial.removed == 0) return;
    in_vain_ = 0;
    done_ += static_cast<std::uint64_t>(trial.removed);
    left_[static_cast<std::size_t>(block)] = static_cast<std::uint64_t>(trial.left);
    at_ = trial.at;
    next_.clear();
    ready_.clear();
    for (std::uint32_t b : graph_.of(block)) {
      if (left_[b] == 0 || octree_.leaves[b].label != Label::remove) continue;
      aside_.erase(static_cast<int>(b));
      open_.insert(static_cast<int>(b));
    }
  }

  const Octree& octree_;
  const BlockGraph& graph_;
  Voxel at_;
  std::vector<std::uint64_t> left_;  // per block: remove voxels still standing
  std::uint64_t total_ = 0, done_ = 0;
  std::vector<std::pair<std::int64_t, int>> next_;  // a heap of what is open, with costs; empty: not known
  std::vector<int> ready_;                          // the next ones of them, the best last
  std::size_t in_vain_ = 0;                         // blocks, since something was removed
  std::set<int> open_, aside_;                      // ids with voxels left: to be tried, and tried without full success
};

}  // namespace

void order_blocks(const Octree& octree, const BlockGraph& graph, Voxel start, int max_effort, const TryBlock& try_block,
                  const Watch& watch, const Foresee& foresee) {
  Order(octree, graph, start).run(max_effort, try_block, watch, foresee);
}

}  // namespace sculpt
