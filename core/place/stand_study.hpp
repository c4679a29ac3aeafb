// Many stands of a cell, each with the share of a target that the arm can come to there: an estimate, best first.
#pragma once

#include <vector>

#include "core/base/run_context.hpp"
#include "core/place/demand.hpp"

namespace sculpt {

/// Values from one to another, both included; one step: `from` alone.
struct StandRange {
  double from = 0, to = 0;
  int steps = 1;

  /// In order.
  std::vector<double> values() const;
};

/// Every combination of these is a stand. Metres and radians, as in Stand.
struct StandRanges {
  StandRange x, y, z, turn, height, stickout;
};

/// Where the cell stands, and around it: 11 x 9 places as far off as one and a half edges of the block, at 5 heights of
/// the moved joint up to one edge higher and lower; turn, height of the block and tool as they are.
StandRanges ranges_around(const Cell& cell, int joint);

/// All of them, and the cell's own if it is not among them. Throws InputError `cell_invalid` for more than 20 000.
std::vector<Stand> list_stands(const StandRanges& ranges, const Stand& own);

struct RatedStand {
  Stand stand;
  ArmReach reach;
  Share share;
};

/// Best first: by what is held, then by along how many directions, then by how near it is to the cell's own stand.
/// The same at any number of threads. Tells the watch (stage `plan`) of every stand. Throws Cancelled.
std::vector<RatedStand> rate_stands(const ReachStudy& study, const Demand& demand, const std::vector<Stand>& stands,
                                    const Stand& own, const RunContext& run);

}  // namespace sculpt
