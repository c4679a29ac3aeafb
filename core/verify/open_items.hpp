// A piece of a trajectory -> what must be looked at on the way to which of its keyframes. Internal to verify/.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/verify/robot/link_motion.hpp"
#include "core/verify/trajectory_pieces.hpp"

namespace sculpt {

/// Things that could touch are tried over boxes of configurations that many keyframes share: all of the piece first,
/// then halves of it for those that are still open, down to a few keyframes.
class OpenItems {
 public:
  /// Configurations no more than `half` from the middle.
  struct Box {
    Configuration middle, half;
    std::vector<Frame> poses;  ///< of the links, in the middle
  };
  /// Could this item touch something in the box? A "no" must be certain.
  using MayTouch = std::function<bool(std::size_t item, const Box& box)>;

  OpenItems() = default;
  /// Nothing is proved: all of them are open all along.
  OpenItems(const TrajectoryPiece& piece, std::size_t count);
  /// Items 0 to `count` - 1. What is said of them must stay true as long as the object is asked.
  OpenItems(const LinkMotion& motion, const TrajectoryPiece& piece, std::size_t count, const MayTouch& may_touch);

  /// Those that may touch on the way to the keyframe of this index in the piece.
  const std::vector<std::size_t>& of(std::size_t keyframe) const { return open_[keyframe / keyframes_a_block]; }

 private:
  static constexpr std::size_t keyframes_a_block = 8;
  static std::size_t blocks_of(const TrajectoryPiece& piece);
  struct Trial;
  void find(const Trial& trial, std::size_t first, std::size_t end, const std::vector<std::size_t>& items);

  std::vector<std::vector<std::size_t>> open_;  ///< by block
};

}  // namespace sculpt
