#include "core/verify/timed/law_replay.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

// Of a length or an x, as 32 bits have it.
constexpr double law_slack = 1e-6;

// q(r) = p0 + p1 r + p2 r^2 / 2 with r = v t + s t^2 / 2, multiplied out.
void compose(TimePolynomial& piece, const Configuration& p0, const Configuration& p1, const Configuration& p2, double v,
             double s) {
  piece.speed = v;
  piece.rise = s;
  piece.c[0] = p0;
  piece.c[1] = v * p1;
  piece.c[2] = s / 2 * p1 + v * v / 2 * p2;
  piece.c[3] = v * s / 2 * p2;
  piece.c[4] = s * s / 8 * p2;
}

}  // namespace

LawReplay::LawReplay(TrajectoryReader& plan, const LawFile& law, Find find)
    : plan_(plan), law_(law), find_(std::move(find)), at_(plan.header().home) {
  weights_.resize(static_cast<Eigen::Index>(law.law.acceleration.size()));
  for (Eigen::Index joint = 0; joint < weights_.size(); ++joint)
    weights_[joint] = law.law.acceleration[static_cast<std::size_t>(joint)];
  if (weights_.size() != at_.size()) {
    find_(0,
          "the law is for " + std::to_string(weights_.size()) + " joints, the plan has " + std::to_string(at_.size()));
    broken_ = true;
  }
  points_.push_back(at_);
  gone_.push_back(0);
  numbers_.push_back(0);
  mill_.emplace_back();
}

std::optional<LawReplay::Step> LawReplay::read_step() {
  while (auto keyframe = plan_.next()) {
    mark_.add(keyframe->q);
    if (mark_.keyframes > law_.law.corners.size()) {
      find_(mark_.keyframes, "the law ends before the plan does");
      broken_ = true;
      return std::nullopt;
    }
    const int tool = tool_;
    if (keyframe->mill && keyframe->mill->tool >= 0) tool_ = keyframe->mill->tool;
    if (keyframe->q == points_.back()) continue;
    Step step{mark_.keyframes, keyframe->q, keyframe->q - points_.back(), 0, 0, keyframe->cut, tool};
    double sum = 0, most = 0;
    for (Eigen::Index joint = 0; joint < weights_.size(); ++joint) {
      const double share = std::abs(step.way[joint]) / weights_[joint];
      sum += share * share;
      most = std::max(most, share);
    }
    step.length = std::sqrt(sum);
    step.way /= step.length;
    step.acceleration = step.length / most;
    points_.push_back(step.to);
    gone_.push_back(gone_.back() + step.length);
    numbers_.push_back(step.keyframe);
    if (keyframe->mill) {
      const auto& tip = keyframe->mill->tip;  // of 1e-7 m
      mill_.push_back(
          {1e-4 * Vec3(static_cast<double>(tip[0]), static_cast<double>(tip[1]), static_cast<double>(tip[2])),
           keyframe->mill->direction, tool, keyframe->cut});
    }
    return step;
  }
  if (!(mark_ == law_.plan)) find_(mark_.keyframes, "the law was made for other keyframes than the plan has");
  return std::nullopt;
}

std::optional<TimePolynomial> LawReplay::next() {
  while (taken_ == ready_.size()) {
    if (broken_) return std::nullopt;
    ready_.clear();
    taken_ = 0;
    if (!started_) {
      started_ = true;
      ahead_ = read_step();
    }
    if (!ahead_) return std::nullopt;
    const Step step = *ahead_;
    ahead_ = read_step();
    if (broken_) return std::nullopt;
    lay_out(step, ahead_);
    before_ = corner(step.keyframe);
    at_ = step.to;
  }
  return ready_[taken_++];
}

// A part of a line on which x goes evenly from one value to another.
bool LawReplay::add_part(const Step& step, double from, double size, std::array<double, 2> x) {
  if (size <= 0) return true;
  const double v0 = std::sqrt(x[0]), v1 = std::sqrt(x[1]), seconds = size / ((v0 + v1) / 2);
  if (!(seconds > 0) || !std::isfinite(seconds)) {
    find_(step.keyframe, "time does not go on on the way to it");
    broken_ = true;
    return false;
  }
  TimePolynomial piece;
  piece.begin_s = time_s_;
  piece.seconds = seconds;
  piece.keyframe = step.keyframe;
  piece.cut = step.cut;
  piece.gone = r_;
  compose(piece, at_ + from * step.way, step.way, Configuration::Zero(at_.size()), v0, (v1 - v0) / seconds);
  ready_.push_back(std::move(piece));
  time_s_ += seconds;
  r_ += size;
  return true;
}

void LawReplay::lay_out(const Step& step, const std::optional<Step>& next) {
  const LawCorner& to = corner(step.keyframe);
  const double behind = static_cast<double>(before_.half), half = next ? static_cast<double>(to.half) : 0;
  const double line = step.length - behind - half;
  if (line < -law_slack * step.length) {
    find_(step.keyframe, "the parabolas at both ends of the edge to it overlap");
    broken_ = true;
    return;
  }
  const double start = static_cast<double>(before_.x_out), end = static_cast<double>(to.x_in),
               cap = static_cast<double>(to.cruise) * static_cast<double>(to.cruise);
  const double top = std::min(cap, start / 2 + end / 2 + step.acceleration * std::max(0.0, line));
  if (start > cap * (1 + law_slack) || end > cap * (1 + law_slack))
    find_(step.keyframe, "the edge to it begins or ends faster than it may be gone");
  const double up = std::max(0.0, (top - start) / (2 * step.acceleration)),
               down = std::max(0.0, (top - end) / (2 * step.acceleration));
  if (up + down > std::max(0.0, line) * (1 + law_slack) + law_slack * step.length) {
    find_(step.keyframe, "the edge to it is too short for its change of speed");
    broken_ = true;
    return;
  }
  if (!add_part(step, behind, up, {start, top}) || !add_part(step, behind + up, line - up - down, {top, top}) ||
      !add_part(step, behind + line - down, down, {top, end}))
    return;
  if (!next) {
    if (to.x_in != 0) find_(step.keyframe, "the motion does not come to rest at the end");
    return;
  }
  if (next->tool != step.tool && (half != 0 || to.x_mid != 0))
    find_(step.keyframe, "the tool is changed while the robot moves");
  if (half == 0 && to.x_mid == 0) {
    if (to.x_in != 0 || to.x_out != 0) find_(step.keyframe, "the motion does not come to rest where it should");
    if (law_.law.window_s == 0) return;
    TimePolynomial piece;
    piece.begin_s = time_s_;
    piece.seconds = law_.law.window_s;
    piece.keyframe = step.keyframe;
    piece.cut = step.cut;
    piece.gone = r_;
    const Configuration none = Configuration::Zero(at_.size());
    compose(piece, step.to, none, none, 0, 0);
    ready_.push_back(std::move(piece));
    time_s_ += law_.law.window_s;
    return;
  }
  if (half == 0) {
    if (step.way != next->way) find_(step.keyframe, "the motion turns at once");
    return;
  }
  const Configuration bend = (next->way - step.way) / (2 * half);
  for (const bool second : {false, true}) {
    const double from = static_cast<double>(second ? to.x_mid : to.x_in),
                 until = static_cast<double>(second ? to.x_out : to.x_mid), v0 = std::sqrt(from), v1 = std::sqrt(until);
    TimePolynomial piece;
    piece.begin_s = time_s_;
    piece.seconds = half / ((v0 + v1) / 2);
    if (!(piece.seconds > 0) || !std::isfinite(piece.seconds)) {
      find_(step.keyframe, "time does not go on at it");
      broken_ = true;
      return;
    }
    piece.keyframe = step.keyframe;
    piece.cut = second ? next->cut : step.cut;
    piece.gone = r_;
    const Configuration begin = step.to - half * step.way;
    const double s = (v1 - v0) / piece.seconds;
    if (second)
      compose(piece, begin + half * step.way + half * half / 2 * bend, step.way + half * bend, bend, v0, s);
    else
      compose(piece, begin, step.way, bend, v0, s);
    time_s_ += piece.seconds;
    r_ += half;
    ready_.push_back(std::move(piece));
  }
}

}  // namespace sculpt
