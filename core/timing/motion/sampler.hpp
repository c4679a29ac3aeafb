// Plan and law -> where the joints are at a time, moving average included: what a controller is to be given.
#pragma once

#include <deque>
#include <vector>

#include "core/timing/motion/held_pieces.hpp"

namespace sculpt {

struct MotionSample {
  Configuration q, velocity;
};

/// Fastest for times that rise. Not shared between threads.
class MotionSampler {
 public:
  /// Path and law must outlive it. Reads the law once from end to end.
  MotionSampler(const PlanPath& path, const TimeLaw& law);

  /// From standing at home to standing at the last point.
  double duration_s() const { return duration_s_; }
  /// As HeldPieces::hold; with it the motion lasts longer.
  void hold(const std::vector<double>& begins_s);
  const std::vector<PathHold>& holds() const { return pieces_.holds(); }
  /// Before 0 and after the end it stands.
  MotionSample at(double time_s);
  /// When the motion is nearest to a point: the middle of its parabola or rest, half a window later.
  /// Of the points one after the other; 0 of home. Of the motion without holds.
  std::vector<double> times_of_points() const;
  /// The point that the unfiltered motion was on its way to half a window ago.
  std::size_t point_at(double time_s);

 private:
  /// A piece, and the integral of q over all of it: windows that follow each other mostly have whole pieces in them.
  struct Held {
    MotionPiece piece;
    Configuration integral;
  };

  void reach(double from_s, double to_s);
  /// The held piece that is not over by then; none behind the last. Pieces follow each other without a gap, but for
  /// what their times are rounded by.
  const MotionPiece* piece_at(double time_s) const;
  /// The joints, not averaged, with the pieces at that time held.
  Configuration q_at(double time_s) const;
  /// Their integral over a window of the law that ends at that time, its pieces held.
  Configuration integral_until(double time_s) const;

  const PlanPath& path_;
  const TimeLaw& law_;
  HeldPieces pieces_;
  std::deque<Held> held_;  // what windows of late were in, without a gap
  bool ended_ = false;
  double duration_s_ = 0;
};

}  // namespace sculpt
