// Rows over what is to come off at one level.
//
// Seen along the axis; @ is where the tip may not be, # what is to come off, the numbers are rows:
//
//      around:  . 3 # # # 3 .      along:  . 2 2 2 2 2 2 .
//               . # 2 2 2 # .              . # # # # # # .
//               . 2 1 1 1 2 .              . 1 1 0 0 1 1 .
//               . 2 1 @ 1 2 .              . # 0 @ @ 0 # .
//               . 2 1 1 1 2 .              . 1 1 0 0 1 1 .
//
// Around are level curves of the distance from @, from the outside inwards: corners first, closed ones last. Along are
// straight rows, from both sides to the middle, and one last row around @; without one from one side to the other.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/cell/milling/mill_tool.hpp"
#include "core/mill/rough/level_row.hpp"

namespace sculpt {

enum class RowLayout { around, along_u, along_v };

/// May the tip go straight from one place to the other? `is_free`: by cell of the lattice.
bool edge_is_free(const Lattice& lattice, const std::vector<char>& is_free, const Point2& from, const Point2& to);

/// How far inside the edge of a slab, as thick as the depth of cut, the tip takes off depth times width; negative: so
/// far outside. To `step_m`, and no more.
double first_row_inside(const MillTool& tool, double step_m);

/// What rows are laid for.
struct LevelArea {
  const Lattice& lattice;
  const std::vector<char>& is_free;  ///< by cell: may the tip be there?
  const std::vector<char>& stands;   ///< by cell: is it to come off?
  double radius_m = 0;               ///< of the cutter
  double width_m = 0;                ///< from row to row
  double cleared_m = 0;              ///< beside a row nothing stands any more, so far
  double inside_m = 0;               ///< of the edge of what is to come off: the outermost straight row
  double step_m = 0;                 ///< edges are no longer
};

/// Owns the fields of its rows. Immutable.
class LevelRows {
 public:
  /// What `task` refers to must outlive the object. Around where the tip may be everywhere there are none.
  LevelRows(const LevelArea& task, RowLayout layout);

  const std::vector<LevelRow>& rows() const { return rows_; }

 private:
  bool edge_is_free(const Point2& from, const Point2& to) const {
    return sculpt::edge_is_free(task_.lattice, task_.is_free, from, to);
  }
  bool is_needed(const RowField& field, const Point2& p, double inside, double outside) const;
  void lay_around(double farthest);
  void lay_straight(double farthest, bool any);
  void leave_for_ring();
  void lay(const RowField& field, int rank, double value, double inside, double outside);
  void lay(const RowField& field, int rank, double value, const std::function<bool(const Point2&)>& is_wanted);
  bool is_narrow(const Point2& p) const;
  void lay_ring(double outside);
  bool turn_to_gap(Curve& ring, std::vector<char>& needed) const;
  std::size_t end_of_stretch(const Curve& curve, const std::vector<char>& needed, std::size_t begin) const;
  void add_stretches(LevelRow row, const Curve& curve, const std::vector<char>& needed);
  Curve straightened(const Curve& curve) const;
  void clear_beside(const LevelRow& row);

  LevelArea task_;
  std::vector<char> stands_;  ///< what rows are still to be laid for
  std::vector<std::unique_ptr<RowField>> fields_;
  std::vector<LevelRow> rows_;
};

}  // namespace sculpt
