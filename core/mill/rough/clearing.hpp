// Roughing of one level: the tip stays at one height and takes off what is above it, never more at once than is
// allowed.
//
// Seen along the axis; o is the cutter, # what is to come off, the path so far comes from the left:
//
//          . . . . . . # # # #        The cutter keeps along what stands, its rim a width of cut inside: from where it
//          is
//          - - - - -(o)# # # #        it goes on where the distance to what stood when the pass began is radius less
//          # # # # # # # # # #        width. An edge that would take off more than depth times width a unit of length
//          is # # # # # # # # # #        not taken: then it keeps off a little more, and so it enters bit by bit as
//          well.
//
// So passes are contour-parallel, one inside the other, and the engagement is not promised by their geometry but
// measured for each edge: offsets alone do not keep it where corners are hollow (Elber, Cohen, Drake, "MATHSM: medial
// axis transform toward high speed machining of pockets", 2005).
#pragma once

#include <optional>
#include <vector>

#include "core/mill/rough/stock_top.hpp"

namespace sculpt {

/// What one level is cleared with.
struct ClearingTask {
  const MillTool& tool;
  double height = 0;  ///< of the tip
  /// Of the depth of cut: what stands higher than this above the level is to come off, the rest are cusps.
  double cusp_share = 0;
  const std::vector<char>& is_free;  ///< by cell: may the tip be there?
};

/// Edges at the height of the level. Those that come before the first cut lead through what is open.
using LevelPass = std::vector<Point2>;

/// Plans passes, one after the other, and takes off the surface what they cut. Not shared between threads.
class Clearing {
 public:
  /// `surface` and what `task` refers to must outlive the object.
  Clearing(const ClearingTask& task, StockTop& surface);

  /// About what is to come off here (m^3).
  double volume_to_clear() const;
  /// The next pass from `at`, where the tip is in the open at this height, or nothing if none can be come to from there
  /// within what is open. It begins at `at`.
  std::optional<LevelPass> next_from(const Point2& at);
  /// A place in the open from which a pass can be come to, near `at`; nothing if there is none.
  std::optional<Point2> find_entry(const Point2& at) const;
  /// Smaller chips count from now on; false if they were the smallest already.
  bool lower_threshold();

 private:
  struct Step {
    Point2 to;
    double heading = 0, volume = 0;
  };

  /// The cutter touches little there, or nothing.
  bool is_open(std::size_t at) const { return task_.is_free[at] && touching_[at] <= little_; }
  bool may_begin(int a, int b) const;
  bool edge_is_free(const Point2& from, const Point2& to) const;
  bool edge_is_open(const Point2& from, const Point2& to) const;
  Vec3 at_level(const Point2& p) const { return {p.x(), p.y(), task_.height}; }
  double volume(const Point2& from, const Point2& to) const;
  double distance(const Point2& p) const;
  std::optional<Step> best_step(const Point2& from, double heading, double widest_turn) const;
  void cut(const Point2& from, const Point2& to);
  void find_reachable();
  void count_touching();
  void untouch(std::size_t at);
  std::vector<Point2> straightened(const std::vector<Point2>& way) const;
  void follow(LevelPass& pass);

  ClearingTask task_;
  StockTop& surface_;
  const Lattice& lattice_;
  double step_m_, cap_m3_m_;  ///< edges; volume by length
  double beside_m_;           ///< how far the tip keeps from what stands
  double threshold_;          ///< share of the cap that a step must take off
  float stands_above_;        ///< cells higher than this are to come off
  std::vector<int> disc_;     ///< by row from -reach to reach: half the width of the cutter's disc in cells; -1: none
  int reach_ = 0, far_ = 0;   ///< cells: of the cutter's radius, and beyond it as far as a pass looks
  std::uint16_t little_ = 0;  ///< cells that a way through what is open may touch
  std::vector<char> stands_;  ///< by cell: to come off at this level
  std::vector<std::uint16_t> touching_;  ///< by cell: how many of those a cutter there touches
  std::vector<float> distance_;          ///< of a cell to those, when the pass began
  bool is_measured_ = false;
  std::vector<char> tried_;          ///< in vain, with this threshold
  std::vector<std::uint32_t> seen_;  ///< by a search
  std::uint32_t search_ = 0;
  std::vector<std::int32_t> parent_;
};

}  // namespace sculpt
