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
  const bool behind = !held_.empty() && from_s < held_.front().begin_s,
             far_ahead = !held_.empty() && !ended_ && from_s > held_.back().end_s() + far_s;
  if (held_.empty() || behind || far_ahead) {
    held_.clear();
    ended_ = false;
    pieces_.go_to(from_s);
  }
  MotionPiece piece;
  while (!ended_ && (held_.empty() || held_.back().end_s() < to_s)) {
    if (!pieces_.next(piece)) {
      ended_ = true;
      break;
    }
    held_.push_back(piece);
    while (held_.size() > 1 && held_.front().end_s() < from_s) held_.pop_front();
  }
  while (held_.size() > 1 && held_.front().end_s() < from_s) held_.pop_front();
}

MotionSample MotionSampler::at(double time_s) {
  const double from = std::clamp(time_s - law_.window_s, 0.0, duration_s_), to = std::clamp(time_s, 0.0, duration_s_);
  const Configuration home = path_.configuration(0), end = path_.configuration(path_.size() - 1);
  if (path_.size() == 1 || time_s <= 0) return {home, Configuration::Zero(home.size())};
  if (time_s >= duration_s_) return {end, Configuration::Zero(home.size())};
  reach(from, to);
  const auto place = [&](double time) -> std::pair<Configuration, Configuration> {
    if (time <= 0) return {home, Configuration::Zero(home.size())};
    for (const MotionPiece& piece : held_)
      if (time >= piece.begin_s && time <= piece.end_s())
        return {piece.q(time - piece.begin_s), piece.velocity(time - piece.begin_s)};
    return {end, Configuration::Zero(home.size())};
  };
  if (law_.window_s == 0) {
    const auto [q, velocity] = place(to);
    return {q, velocity};
  }
  const double window = law_.window_s;
  Configuration sum = Configuration::Zero(home.size());
  double covered = 0;
  if (time_s < window) {
    sum += home * (window - time_s);
    covered += window - time_s;
  }
  for (const MotionPiece& piece : held_) {
    const double begin = std::max(from, piece.begin_s), finish = std::min(to, piece.end_s());
    if (finish <= begin) continue;
    sum += piece.integral(begin - piece.begin_s, finish - piece.begin_s);
    covered += finish - begin;
  }
  sum += end * (window - covered);
  return {sum / window, (place(time_s).first - place(time_s - window).first) / window};
}

std::size_t MotionSampler::point_at(double time_s) {
  const double time = std::clamp(time_s - law_.window_s / 2, 0.0, duration_s_);
  reach(time, time);
  for (const MotionPiece& piece : held_)
    if (time <= piece.end_s()) return piece.point;
  return path_.size() - 1;
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
