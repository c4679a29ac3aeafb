#include "core/verify/trajectory_pieces.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace sculpt {
namespace {

constexpr std::size_t max_unseen = 32;
constexpr std::chrono::milliseconds idle_every(100);

}  // namespace

TrajectoryPieces::TrajectoryPieces(TrajectoryReader& reader)
    : reader_(reader), at_(reader.header().home), cuts_(reader.header().grid.n), unseen_(1), busy_(1, false) {}

void TrajectoryPieces::join(std::size_t count) {
  const std::lock_guard lock(mutex_);
  unseen_.resize(unseen_.size() + count);
  busy_.resize(unseen_.size(), false);
}

TrajectoryPieces::Piece TrajectoryPieces::read() {
  const auto piece = std::make_shared<TrajectoryPiece>();
  piece->index = read_;
  piece->from = at_;
  while (piece->keyframes.size() < keyframes_a_piece) {
    auto keyframe = reader_.next();
    if (!keyframe) {
      all_read_ = true;
      break;
    }
    if (piece->keyframes.empty()) piece->first_line = reader_.line();
    if (keyframe->cut) cuts_.add(*keyframe, reader_.line());
    piece->keyframes.push_back(std::move(*keyframe));
  }
  if (piece->keyframes.empty()) return nullptr;
  at_ = piece->keyframes.back().q;
  ++read_;
  return piece;
}

bool TrajectoryPieces::may_go_on() const {
  if (abandoned_) return true;
  if (all_read_) return std::find(busy_.begin(), busy_.end(), true) == busy_.end();
  // Who is not busy waits here too, and takes what it has not seen as soon as it goes on.
  for (std::size_t other = 0; other < unseen_.size(); ++other)
    if (busy_[other] && unseen_[other].size() >= max_unseen) return false;
  return true;
}

TrajectoryPieces::Piece TrajectoryPieces::next(std::size_t worker, std::vector<Piece>& before,
                                               const std::function<void()>& idle) {
  std::unique_lock lock(mutex_);
  busy_[worker] = false;
  Piece piece;
  while (!piece) {
    changed_.notify_all();
    while (!changed_.wait_for(lock, idle_every, [this] { return may_go_on(); })) idle();
    if (abandoned_ || all_read_) break;
    piece = read();
  }
  before = std::exchange(unseen_[worker], {});
  if (!piece) return nullptr;
  busy_[worker] = true;
  for (std::size_t other = 0; other < unseen_.size(); ++other)
    if (other != worker) unseen_[other].push_back(piece);
  changed_.notify_all();
  return piece;
}

void TrajectoryPieces::abandon() {
  const std::lock_guard lock(mutex_);
  abandoned_ = true;
  changed_.notify_all();
}

}  // namespace sculpt
