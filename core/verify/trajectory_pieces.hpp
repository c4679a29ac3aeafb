// A trajectory in pieces that several workers replay at the same time. Internal to verify/.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "core/trajectory/keyframe.hpp"
#include "core/trajectory/reader.hpp"
#include "core/verify/material/cut_log.hpp"

namespace sculpt {

/// Cut at fixed places, whoever replays it: a verdict must not depend on the number of workers.
struct TrajectoryPiece {
  std::size_t index = 0;
  std::uint64_t first_line = 0;
  Configuration from;  ///< where the piece before ends
  std::vector<Keyframe> keyframes;
};

/// Safe from all threads, after construction.
class TrajectoryPieces {
 public:
  using Piece = std::shared_ptr<const TrajectoryPiece>;

  static constexpr std::size_t keyframes_a_piece = 1024;

  /// For worker 0. The reader must outlive this and stand after the header.
  explicit TrajectoryPieces(TrajectoryReader& reader);

  /// So many more workers, numbered on from those there are; they have seen all that was given out until now.
  void join(std::size_t count);

  /// The next piece that nobody has, and in `before` all pieces since this worker's last one, in order: others replay
  /// them. Null when the pieces of all workers are done; `before` then holds the rest. Reading runs at most a few dozen
  /// pieces ahead of the slowest worker. Calls `idle` now and then while it waits; what that throws passes through, so
  /// does what the reader throws.
  Piece next(std::size_t worker, std::vector<Piece>& before, const std::function<void()>& idle);

  /// All workers get null from now on.
  void abandon();

  /// Where the trajectory ends, once `next` gave null.
  const Configuration& end() const { return at_; }
  /// All that it cuts, once `next` gave null.
  const CutLog& cuts() const { return cuts_; }

 private:
  Piece read();
  bool may_go_on() const;

  TrajectoryReader& reader_;
  Configuration at_;
  CutLog cuts_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::vector<Piece>> unseen_;  // by worker
  std::vector<bool> busy_;
  std::size_t read_ = 0;
  bool all_read_ = false, abandoned_ = false;
};

}  // namespace sculpt
