// What the ball does along a tilted tool direction, cell by cell: no joints yet.
//
// Seen from the side in cells of a view of 6, the axis leans by one cell to the right for one up; # and w stand, w is
// wanted:
//
//      c = 7   . . . g . . . .      g: the gate, where sorties begin and end
//      c = 3   # # . . . .
//      c = 2   # # . . . .          (2, 1) is lit: the tool touches (3, 1), (2, 2), (3, 2) and so on: air
//      c = 1   # # w . # #
//      c = 0   # # # w # #          (3, 0) is not: # stands at (4, 0)
//
// A sortie: from the gate, beside the grid, to (7, 6), where the line of (2, 1) is two cells out, in along the line to
// (3, 2), and with one step more (2, 1) is cut. From there steps across a face or along the axis through lit air are
// tried to other cuts, those across the axis first; if none is found within 3000 cells (256, if none is as near as 16
// steps), the ball goes out along the axis and in to the nearest lit one. At last back to the gate. Where the arm
// cannot follow, the sortie is taken back and the cut that failed given up.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/sweep/reach/tool_shadow.hpp"
#include "core/sweep/reach/tool_view.hpp"
#include "core/sweep/stroke.hpp"

namespace sculpt {

/// Strokes from outside the material to some cuts and out again to where they began.
struct Sortie {
  std::vector<Stroke> strokes;
  /// Per stroke, which of them is the cut that it serves: it comes to that cut, or leaves from the last one.
  std::vector<std::size_t> serves;
  std::size_t cuts = 0;  ///< voxels
};

/// The ball goes from cell to cell, across a face or along the axis, through cells that hold nothing and at which the
/// tool fits (ToolShadow); outside the grid it goes straight. Not shared between threads.
class SlantedCuts {
 public:
  /// `wanted`: what to cut of what stands. `gate`: where sorties begin and end, a voxel above the grid's topmost cells.
  /// `reachable`: is the arm able to hold the ball's centre at this cell, links and joint limits considered? If it says
  /// so of a cell, it must say so of every cell from there out along the axis: a ball that came in can then go out.
  /// `take`: is asked of each voxel that is about to be cut; where it says no the voxel is left for good.
  SlantedCuts(const ToolView& view, const VoxelSet& standing, const std::vector<Voxel>& wanted, Voxel gate,
              std::function<bool(const Vec3& cell)> reachable, std::function<bool(Voxel)> take);

  /// Cuts up to `most` voxels, always the nearest; no strokes if there is none left.
  Sortie plan_sortie(std::size_t most);

  /// As if a sortie had not been planned, the last ones first.
  void take_back(const Sortie& sortie);
  /// The voxels of this cut are not tried again.
  void give_up(const Stroke& cut);

 private:
  struct Hop {
    Voxel cell;
    std::size_t before;  ///< which hop led here
  };

  /// What the ball may do at a cell: nothing, be there, or cut what stands there.
  enum class Place { closed, free, to_cut };

  bool is_in_bounds(Voxel cell) const;
  bool is_reachable(Voxel cell) const;
  Place look_at(Voxel cell) const;
  Voxel way_out(Voxel cell) const;
  bool cut_near(Sortie& sortie);
  /// Is there a cut that so many steps through air could lead to?
  bool is_any_within(int steps);
  void drop_stale();
  bool cut_far(Sortie& sortie);
  void retrace(Sortie& sortie);
  std::optional<std::vector<Voxel>> route(Voxel out, Voxel in) const;
  bool is_reachable_between(Voxel from, Voxel to) const;
  void walk(std::size_t hop, Sortie& sortie);
  void go(Voxel cell, double tolerance, Sortie& sortie);
  bool may_cut(Voxel cell);
  void cut(Voxel cell, Sortie& sortie);
  /// Is it the first time that the search comes to this cell, and in its window?
  bool see(Voxel cell);
  void forget_seen();

  ToolView view_;
  Voxel gate_;
  std::function<bool(const Vec3&)> reachable_;
  std::function<bool(Voxel)> take_;
  ToolShadow shadow_;
  VoxelSet wanted_;                     ///< less what was given up
  std::vector<Voxel> lit_;              ///< cells that may be cut now, and some that no longer are there
  Voxel at_;                            ///< the ball
  Voxel last_step_{};                   ///< of the ball; none where it did not step to a neighbour
  std::vector<Hop> hops_;               ///< of the search for the nearest cut, kept to save allocations
  std::vector<std::uint64_t> seen_;     ///< by that search, in a window around the ball: rows of bits
  std::vector<std::size_t> seen_rows_;  ///< those that are not empty
};

}  // namespace sculpt
