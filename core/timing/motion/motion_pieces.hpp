// Plan and law -> the motion, piece by piece: each with constant r''.
#pragma once

#include <algorithm>
#include <functional>

#include "core/law/time_law.hpp"
#include "core/timing/plan_path.hpp"

namespace sculpt {

/// q(s) = at + way s + bend s^2 / 2, where s(t) = speed t + rise t^2 / 2 for t from 0 to `seconds`. Before the moving
/// average.
struct MotionPiece {
  double begin_s = 0, seconds = 0;
  double speed = 0, rise = 0;
  Configuration at, way, bend;
  std::size_t point = 0;  ///< of the path: on the edge to it, or on the parabola at it
  bool parabola = false;

  double end_s() const { return begin_s + seconds; }
  double length() const { return (speed + rise * seconds / 2) * seconds; }
  /// Square of the speed where it has gone so far.
  double x_at(double s) const { return std::max(0.0, speed * speed + 2 * rise * s); }
  /// Until it has gone so far; 0 where it has not begun to move.
  double seconds_to(double s) const;
  /// From its time t on, and until then.
  MotionPiece behind(double t) const;
  MotionPiece before(double t) const;
  /// At the time t of the piece.
  Configuration q(double t) const;
  Configuration velocity(double t) const;
  /// Integral of q over t from `from` to `to`.
  Configuration integral(double from, double to) const;
};

/// Reads them one after the other; path and law must outlive it. Its law must be one of the path: as many keyframes and
/// joints, else InputError `law_invalid`.
class MotionPieces {
 public:
  MotionPieces(const PlanPath& path, const TimeLaw& law);

  /// False at the end.
  bool next(MotionPiece& piece);
  /// Where `next` is: before it was called for the first time, and after the pieces of each point. Can be gone back to.
  struct Mark {
    std::size_t point = 0;
    double time_s = 0;
  };
  Mark mark() const { return mark_; }
  void go_to(const Mark& mark);

 private:
  void fill();
  void add_line(const LawCorner& from, const LawCorner& to);
  void add(double length, double x0, double x1, MotionPiece piece);
  const LawCorner& corner(std::size_t point) const;
  double edge(std::size_t point, Configuration& way) const;

  const PlanPath& path_;
  const TimeLaw& law_;
  Configuration acceleration_;
  Mark mark_;
  double time_s_ = 0;
  std::vector<MotionPiece> ready_;  // of one point
  std::size_t taken_ = 0;
};

}  // namespace sculpt
