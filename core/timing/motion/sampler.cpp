#include "core/timing/motion/sampler.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {

MotionSampler::MotionSampler(const PlanPath& path, const TimeLaw& law) : path_(path), law_(law), pieces_(path, law) {
  hold({});
}

void MotionSampler::hold(const std::vector<double>& begins_s) {
  pieces_.hold(begins_s);
  held_.clear();
  ended_ = false;
  duration_s_ = path_.size() > 1 ? pieces_.end_s() + law_.window_s : 0;
}

// All pieces that overlap the times are held.
void MotionSampler::reach(double from_s, double to_s) {
  constexpr double far_s = 1;
  const bool behind = !held_.empty() && from_s < held_.front().piece.begin_s,
             far_ahead = !held_.empty() && !ended_ && from_s > held_.back().piece.end_s() + far_s;
  if (held_.empty() || behind || far_ahead) {
    held_.clear();
    ended_ = false;
    pieces_.go_to(from_s);
  }
  const auto let_go = [&] {
    while (held_.size() > 1 && held_.front().piece.end_s() < from_s) held_.pop_front();
  };
  MotionPiece piece;
  while (!ended_ && (held_.empty() || held_.back().piece.end_s() < to_s)) {
    ended_ = !pieces_.next(piece);
    if (ended_) break;
    held_.push_back({piece, piece.integral(0, piece.seconds)});
    let_go();
  }
  let_go();
}

const MotionPiece* MotionSampler::piece_at(double time_s) const {
  const auto at = std::ranges::find_if(held_, [time_s](const Held& held) { return time_s <= held.piece.end_s(); });
  return at == held_.end() ? nullptr : &at->piece;
}

Configuration MotionSampler::q_at(double time_s) const {
  if (time_s <= 0) return path_.configuration(0);
  const MotionPiece* const piece = piece_at(time_s);
  return piece == nullptr ? path_.configuration(path_.size() - 1) : piece->q(std::max(0.0, time_s - piece->begin_s));
}

Configuration MotionSampler::integral_until(double time_s) const {
  const double window = law_.window_s, from = std::clamp(time_s - window, 0.0, duration_s_);
  Configuration sum = Configuration::Zero(static_cast<Eigen::Index>(path_.dof()));
  double covered = 0;
  if (time_s < window) {
    sum += path_.configuration(0) * (window - time_s);
    covered += window - time_s;
  }
  for (const auto& [piece, integral] : held_) {
    const double begin = std::max(from, piece.begin_s), finish = std::min(time_s, piece.end_s());
    if (finish <= begin) continue;
    const bool whole = begin == piece.begin_s && finish == piece.end_s();
    sum += whole ? integral : piece.integral(begin - piece.begin_s, finish - piece.begin_s);
    covered += finish - begin;
  }
  return sum + path_.configuration(path_.size() - 1) * (window - covered);
}

MotionSample MotionSampler::at(double time_s) {
  const Configuration still = Configuration::Zero(static_cast<Eigen::Index>(path_.dof()));
  if (path_.size() == 1 || time_s <= 0) return {path_.configuration(0), still};
  if (time_s >= duration_s_) return {path_.configuration(path_.size() - 1), still};
  const double window = law_.window_s;
  reach(std::max(0.0, time_s - window), time_s);
  if (window > 0) return {integral_until(time_s) / window, (q_at(time_s) - q_at(time_s - window)) / window};
  const MotionPiece* const piece = piece_at(time_s);
  return {q_at(time_s), piece == nullptr ? still : piece->velocity(std::max(0.0, time_s - piece->begin_s))};
}

std::size_t MotionSampler::point_at(double time_s) {
  const double time = std::clamp(time_s - law_.window_s / 2, 0.0, duration_s_);
  reach(time, time);
  const MotionPiece* const piece = piece_at(time);
  return piece == nullptr ? path_.size() - 1 : piece->point;
}

std::vector<double> MotionSampler::times_of_points() const {
  std::vector<double> times(path_.size(), 0);
  MotionPieces pieces(path_, law_);
  MotionPiece piece;
  double end_s = 0;
  std::size_t seen = 0;  // the point whose first half of the parabola was the last one
  while (pieces.next(piece)) {
    end_s = piece.end_s();
    if (piece.parabola && piece.point == seen) continue;
    const bool rests = piece.parabola && piece.speed == 0 && piece.rise == 0;
    times[piece.point] = rests ? piece.begin_s + piece.seconds / 2 : end_s;
    if (piece.parabola) seen = piece.point;
  }
  for (std::size_t point = 1; point < times.size(); ++point) times[point] += law_.window_s / 2;
  if (times.size() > 1) times.back() = end_s + law_.window_s;
  return times;
}

}  // namespace sculpt
