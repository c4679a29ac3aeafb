// Plan, law and when to hold -> the motion, piece by piece: on the law's path it comes to rest, and goes on.
//
// A motion along the path that is slower than the law everywhere, x(r) = c x_law(r) with c of 0 to 1, needs only c
// times the law's accelerations. So from any speed below the law's there is a way on that keeps the limits: the law's,
// scaled down. A hold begins with the smallest x that the limits allow, piece after piece, until x is 0; after a rest
// of the window's length it goes on with the largest x until that is the law's. On a piece the joints' accelerations
// are linear in the way gone (as of the law), so they are within limits everywhere if they are so at both ends.
#pragma once

#include <vector>

#include "core/timing/motion/motion_pieces.hpp"

namespace sculpt {

/// Seconds of the motion, moving average included.
struct PathHold {
  double begin_s = 0;  ///< until here it is the motion without this hold
  double rest_s = 0;   ///< from here on it rests for `hold_rest_s`, where it may be left for any time
};
/// So that a driver's samples meet the rest.
inline constexpr double hold_rest_s = 0.1;

/// As MotionPieces, with holds. Not shared between threads.
class HeldPieces {
 public:
  /// Reads the law once from end to end. Path and law must outlive it. Throws as MotionPieces.
  HeldPieces(const PlanPath& path, const TimeLaw& law);

  /// Instead of those of before. Each must begin when the one before it rests, or later, else InputError
  /// `hold_invalid`. One that begins when the motion is nearly over changes nothing: its rest is the end. Back at the
  /// beginning afterwards.
  void hold(const std::vector<double>& begins_s);
  const std::vector<PathHold>& holds() const { return holds_; }

  /// When the last piece ends: a window before the motion, averaged, rests at the end.
  double end_s() const { return law_end_s_ + (splices_.empty() ? 0 : splices_.back().shift_s); }
  /// False at the end.
  bool next(MotionPiece& piece);
  /// The piece that comes next begins at that time or before; with no great haste.
  void go_to(double time_s);

 private:
  /// Pieces in the place of the law's from one time to another.
  struct Splice {
    double from_s = 0, to_s = 0;  ///< of the law
    double shift_s = 0;           ///< behind it, by how much the motion is later than the law
    std::vector<MotionPiece> pieces;
    std::vector<double> law_s;  ///< when the law is where each of them begins
  };
  /// On a piece of the law.
  struct Place {
    MotionPiece piece;
    double s = 0;  ///< way gone on it
    double x = 0;  ///< square of the speed there
    double time_s = 0;
  };

  bool next_of_law(MotionPiece& piece);
  void go_to_law(double law_s);
  /// Where the law is at that time. False at its end.
  bool find(double law_s, Place& place);
  /// On to the next piece of the law that is as long as anything. False at the end.
  bool go_on(Place& place);
  void add(Splice& splice, const Place& from, double length, double rise) const;
  void rest(Splice& splice, const Place& place) const;
  void brake(Splice& splice, Place& place);
  void rise(Splice& splice, Place& place);
  PathHold add_hold(double begin_s);

  const TimeLaw& law_;
  MotionPieces pieces_;
  std::vector<MotionPieces::Mark> marks_;  ///< of the law, every few points
  double law_end_s_ = 0;
  std::vector<PathHold> holds_;
  std::vector<Splice> splices_;
  std::size_t splice_ = 0;  ///< the next one, or the one that is gone through
  std::size_t taken_ = 0;   ///< of its pieces
  bool inside_ = false;     ///< of it
  MotionPiece left_;        ///< of the law, from the end of a splice on
  bool is_left_ = false;
};

}  // namespace sculpt
