#include "core/verify/open_items.hpp"

#include <algorithm>
#include <numeric>

namespace sculpt {

struct OpenItems::Trial {
  const LinkMotion& motion;
  const TrajectoryPiece& piece;
  const MayTouch& may_touch;

  const Configuration& before(std::size_t keyframe) const {
    return keyframe == 0 ? piece.from : piece.keyframes[keyframe - 1].q;
  }
};

OpenItems::OpenItems(const TrajectoryPiece& piece, std::size_t count) : open_(blocks_of(piece)) {
  for (std::vector<std::size_t>& items : open_) {
    items.resize(count);
    std::iota(items.begin(), items.end(), std::size_t{0});
  }
}

OpenItems::OpenItems(const LinkMotion& motion, const TrajectoryPiece& piece, std::size_t count,
                     const MayTouch& may_touch)
    : open_(blocks_of(piece)) {
  std::vector<std::size_t> items(count);
  std::iota(items.begin(), items.end(), std::size_t{0});
  if (!open_.empty()) find({motion, piece, may_touch}, 0, open_.size(), items);
}

std::size_t OpenItems::blocks_of(const TrajectoryPiece& piece) {
  return (piece.keyframes.size() + keyframes_a_block - 1) / keyframes_a_block;
}

/// In blocks `first` to `end` - 1.
void OpenItems::find(const Trial& trial, std::size_t first, std::size_t end, const std::vector<std::size_t>& items) {
  const std::size_t last_keyframe = std::min(end * keyframes_a_block, trial.piece.keyframes.size());
  Configuration low = trial.before(first * keyframes_a_block), high = low;
  for (std::size_t keyframe = first * keyframes_a_block; keyframe < last_keyframe; ++keyframe) {
    low = low.cwiseMin(trial.piece.keyframes[keyframe].q);
    high = high.cwiseMax(trial.piece.keyframes[keyframe].q);
  }
  Box box{(low + high) / 2, (high - low) / 2, {}};
  trial.motion.place_links(box.middle, box.poses);
  std::vector<std::size_t> open;
  for (const std::size_t item : items)
    if (trial.may_touch(item, box)) open.push_back(item);
  if (open.empty()) return;
  if (end - first == 1) {
    open_[first] = std::move(open);
    return;
  }
  const std::size_t middle = first + (end - first) / 2;
  find(trial, first, middle, open);
  find(trial, middle, end, open);
}

}  // namespace sculpt
