// Roughing of one level: the tip stays at one height and takes off what is above it, never more at once than is
// allowed.
//
// Rows are a width of cut apart, and cut from the outside inwards, so that each finds a width of cut before it. Where
// it finds more, in hollow corners, a row half a width farther out goes before it: the engagement is not promised by
// the geometry of rows but measured, for offsets alone do not keep it (Elber, Cohen, Drake, "MATHSM: medial axis
// transform toward high speed machining of pockets", 2005).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/cell/milling/mill_tool.hpp"
#include "core/mill/chip_load.hpp"
#include "core/mill/rough/level_rows.hpp"
#include "core/mill/rough/row_entries.hpp"
#include "core/mill/rough/stock_top.hpp"

namespace sculpt {

/// What one level is cleared with.
struct ClearingTask {
  const MillTool& tool;
  double height = 0;                 ///< of the tip
  double cusp_m = 0;                 ///< may be left
  const std::vector<char>& is_free;  ///< by cell: may the tip be there?
  const std::vector<char>& stands;   ///< by cell: what is to come off
  double seam_m = 0;  ///< of the cutter's radius: nearer to its edge nothing counts as cleared beside a row
  /// The way over to there (tool frame) from where the tip is now, as a length of cut that it is worth (m); nothing if
  /// the robot cannot go it.
  std::function<std::optional<double>(const Vec3&)> way_over_m;
};

/// Places of the tip (tool frame), at the height of the level or on a ramp down to it. The first one is in the open, on
/// top of what stands, or where the tip is.
using LevelPass = std::vector<Vec3>;

/// Plans passes, one after the other, and takes off the surface what they cut. Not shared between threads.
class Clearing {
 public:
  /// `surface` and what `task` refers to must outlive the object.
  Clearing(const ClearingTask& task, RowLayout layout, StockTop& surface);

  /// The next pass, one that begins near `at`; nothing once there is none. `is_down`: the tip is there at this height,
  /// and the pass may begin there.
  std::optional<LevelPass> next_from(const Point2& at, bool is_down);
  /// What passes took off so far (m^3).
  double taken_m3() const { return taken_m3_; }

 private:
  struct Turn {
    LevelRow row;
    std::vector<std::size_t> after = {};  ///< which come before it
    int tries = 0;
    bool is_done = false;
  };

  Vec3 at_level(const Point2& p) const { return {p.x(), p.y(), task_.height}; }
  double volume(const Point2& from, const Point2& to) const;
  bool edge_is_free(const Point2& from, const Point2& to) const {
    return sculpt::edge_is_free(lattice_, task_.is_free, from, to);
  }
  ChipLoad no_load() const;
  ChipLoad load_at(const Point2& begin, const std::optional<Point2>& tip) const;
  bool bears(ChipLoad& load, const Vec3& from, const Vec3& to, double before_m3) const;
  bool may_cut(const LevelWay& way, ChipLoad load) const;
  bool is_open(const Point2& p) const;
  bool is_worth_it(const LevelRow& row) const;
  std::optional<std::size_t> nearest(const Point2& at) const;
  LevelWay enter(const LevelRow& row, const std::optional<Point2>& tip) const;
  double top_along(const LevelRow& row) const;
  LevelPass enter_by_ramp(const LevelRow& row);
  bool go_down(const LevelPass& pass);
  std::optional<Point2> keep_engagement(const Point2& from, const Point2& to, const RowField& field,
                                        ChipLoad& load) const;
  LevelPass follow(std::size_t number, const std::optional<Point2>& tip);
  void put_off(std::size_t number, std::size_t refused);

  ClearingTask task_;
  StockTop& surface_;
  const Lattice& lattice_;
  double cap_m2_;   ///< volume by length
  double width_m_;  ///< from row to row
  ChipLoad load_;   ///< of the run that the last pass ended
  std::optional<LevelRows> rows_;
  std::vector<Turn> turns_;
  double taken_m3_ = 0;
};

}  // namespace sculpt
