// A stand -> where the arm can hold the tool there, direction by direction, whatever is carved: an estimate, from one
// ball position of each sector.
//
// For each direction the sectors are 4 x 4 x 4 ball positions and, along an axis of the grid, 4 x 4 more above it:
//
//      gate    s . . .      s: the place nearest to a seed (PostureSeeds), solved for by itself (solve_ik)
//      c = 3   . . . .      .: from the place beside it, eight at a time (PostureLanes)
//      c = 2   . x . .      x: a link touches something: `links`, or `stock` if it touches the full block only
//      c = 1   . u . .      u: under it: the ball comes in along the axis, so what holds at x holds here
//      c = 0   . u . .
//
// A second and third seed give other branches; a sector takes the best that any of them gives it.
#pragma once

#include <array>
#include <map>
#include <optional>

#include "core/place/arm/hold.hpp"
#include "core/place/arm/posture_seeds.hpp"
#include "core/place/arm/sectors.hpp"
#include "core/place/arm/stand_contacts.hpp"
#include "core/place/stand.hpp"

namespace sculpt {

struct ArmReach {
  /// By direction (study_views) and sector of the grid (sector_index).
  std::array<std::array<Hold, all_sectors>, all_views> holds{};
  bool is_blocked = false;   ///< table or base stands in something: nothing can be held
  bool home_is_free = true;  ///< the cell's own home, at this stand
  std::optional<Configuration>
      above;  ///< a free configuration with the ball over the middle of the block, tool upright
};

/// What is the same for every stand of a cell. Immutable: safe to share between threads.
class ReachStudy {
 public:
  /// `box`: what the stock takes up of the grid, of 1 along each edge. `stickouts_m`: those of the stands to come.
  /// `cell` must outlive the object. `resolution`: of the plan to come, for the tool.
  ReachStudy(const Cell& cell, int joint, const Eigen::AlignedBox3d& box, int resolution,
             const std::vector<double>& stickouts_m);

  /// Any thread. Depends on nothing else than the stand.
  ArmReach find(const Stand& stand) const;

 private:
  const Cell& cell_;
  int joint_;
  Eigen::AlignedBox3d box_;
  int resolution_;
  PostureSeeds seeds_;
  std::map<double, StandContacts> contacts_;  ///< by stick-out
};

}  // namespace sculpt
