#include "core/timing/motion/motion_pieces.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

const LawCorner at_rest{};

}  // namespace

Configuration MotionPiece::q(double t) const {
  const double s = (speed + rise * t / 2) * t;
  return at + way * s + bend * (s * s / 2);
}

Configuration MotionPiece::velocity(double t) const {
  const double s = (speed + rise * t / 2) * t;
  return (way + bend * s) * (speed + rise * t);
}

Configuration MotionPiece::integral(double from, double to) const {
  const auto powers = [&](double t) {
    const double t2 = t * t, t3 = t2 * t;
    // Of s and of s^2.
    return std::pair{speed * t2 / 2 + rise * t3 / 6,
                     speed * speed * t3 / 3 + speed * rise * t2 * t2 / 4 + rise * rise * t2 * t3 / 20};
  };
  const auto [first, first_square] = powers(from);
  const auto [last, last_square] = powers(to);
  return at * (to - from) + way * (last - first) + bend * ((last_square - first_square) / 2);
}

double MotionPiece::seconds_to(double s) const {
  const double sum = speed + std::sqrt(x_at(s));
  return sum > 0 ? std::min(2 * s / sum, seconds) : 0;
}

MotionPiece MotionPiece::behind(double t) const {
  MotionPiece rest = *this;
  rest.at = q(t);
  rest.way += bend * ((speed + rise * t / 2) * t);
  rest.speed += rise * t;
  rest.begin_s += t;
  rest.seconds -= t;
  return rest;
}

MotionPiece MotionPiece::before(double t) const {
  MotionPiece rest = *this;
  rest.seconds = t;
  return rest;
}

MotionPieces::MotionPieces(const PlanPath& path, const TimeLaw& law)
    : path_(path),
      law_(law),
      acceleration_(Eigen::Map<const Configuration>(law.acceleration.data(),
                                                    static_cast<Eigen::Index>(law.acceleration.size()))) {
  if (law.corners.size() != path.keyframes() || law.acceleration.size() != path.dof())
    throw InputError("law_invalid", "the time law is for " + std::to_string(law.corners.size()) + " keyframes of " +
                                        std::to_string(law.acceleration.size()) + " joints, the plan has " +
                                        std::to_string(path.keyframes()) + " of " + std::to_string(path.dof()) +
                                        ": make it again with sculpt time -o");
}

const LawCorner& MotionPieces::corner(std::size_t point) const {
  return point == 0 ? at_rest : law_.corners[path_.edge_to(point).keyframe - 1];
}

double MotionPieces::edge(std::size_t point, Configuration& way) const {
  way = path_.configuration(point) - path_.configuration(point - 1);
  const double length = way.cwiseQuotient(acceleration_).norm();
  way /= length;
  return length;
}

void MotionPieces::go_to(const Mark& mark) {
  mark_ = mark;
  time_s_ = mark.time_s;
  ready_.clear();
  taken_ = 0;
}

bool MotionPieces::next(MotionPiece& piece) {
  while (taken_ == ready_.size()) {
    if (mark_.point + 1 >= path_.size()) return false;
    ready_.clear();
    taken_ = 0;
    ++mark_.point;
    fill();
    mark_.time_s = time_s_;
  }
  piece = ready_[taken_++];
  return true;
}

void MotionPieces::add(double length, double x0, double x1, MotionPiece piece) {
  const double from = std::sqrt(x0), to = std::sqrt(x1);
  if (!(length > 0) || !(from + to > 0)) return;
  piece.begin_s = time_s_;
  piece.seconds = 2 * length / (from + to);
  piece.speed = from;
  piece.rise = (x1 - x0) / (2 * length);
  time_s_ += piece.seconds;
  ready_.push_back(std::move(piece));
}

// The line to a point, then the parabola at it, or the rest there.
void MotionPieces::fill() {
  const std::size_t point = mark_.point;
  MotionPiece piece;
  piece.point = point;
  const double length = edge(point, piece.way);
  const LawCorner &from = corner(point - 1), &to = corner(point);
  const double gone = static_cast<double>(from.half), half = static_cast<double>(to.half);
  const double line = std::max(0.0, length - gone - half),
               a = 1 / piece.way.cwiseQuotient(acceleration_).cwiseAbs().maxCoeff();
  const double x0 = static_cast<double>(from.x_out), x1 = static_cast<double>(to.x_in),
               cruise = std::pow(static_cast<double>(to.cruise), 2), peak = std::min(cruise, (x0 + x1) / 2 + a * line);
  piece.bend = Configuration::Zero(piece.way.size());
  const Configuration start = path_.configuration(point - 1);
  const double rise = std::max(0.0, (peak - x0) / (2 * a)), fall = std::max(0.0, (peak - x1) / (2 * a));
  const auto part = [&](double begin, double size, double first, double last) {
    piece.at = start + piece.way * (gone + begin);
    add(size, first, last, piece);
  };
  part(0, rise, x0, peak);
  part(rise, line - rise - fall, peak, peak);
  part(line - fall, fall, peak, x1);
  if (point + 1 >= path_.size()) return;
  piece.parabola = true;
  if (half > 0) {
    Configuration after;
    edge(point + 1, after);
    piece.bend = (after - piece.way) / (2 * half);
    const Configuration corner_at = path_.configuration(point), before = piece.way;
    piece.at = corner_at - before * half;
    add(half, x1, static_cast<double>(to.x_mid), piece);
    piece.at = corner_at + (after - before) * (half / 4);
    piece.way = (before + after) / 2;
    add(half, static_cast<double>(to.x_mid), static_cast<double>(to.x_out), piece);
  } else if (to.x_mid == 0) {
    piece.at = path_.configuration(point);
    piece.way.setZero();
    piece.begin_s = time_s_;
    piece.seconds = law_.window_s;
    piece.speed = piece.rise = 0;
    time_s_ += piece.seconds;
    ready_.push_back(piece);
  }
}

}  // namespace sculpt
