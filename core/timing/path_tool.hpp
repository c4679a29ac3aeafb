// The tools of a plan, each in the spindle of its cell, and how far it may stray there.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "core/timing/edge.hpp"
#include "core/timing/plan_path.hpp"
#include "core/timing/room/stray_bound.hpp"

namespace sculpt {

/// How far tip and upper end of a milling tool may be from the straight way between two keyframes (m). Points of the
/// tool that are as far from its tip as lever times its length are off by no more than the tip and lever times the sum
/// of both, so with both ends within room, by (1 + 2 lever) room.
struct MillRoom {
  double cut_m = 0;  ///< the cutter within the header's stray_m, what is above it within 0.2 mm: edges use some of it
  double digits_m = 0;   ///< of a cut, besides: a micrometre of the cutter
  double move_m = 0;     ///< held in a direction: maps keep 0.1 mm off besides what edges stray
  double transit_m = 0;  ///< else: certified as a link is

  /// On an edge, besides what the edge itself strays.
  double beside(const PlanPath::Edge& edge) const { return edge.cut ? digits_m : edge.placed ? move_m : transit_m; }
};

/// Not copied: its parts refer to one another.
class PathTool {
 public:
  /// The thin tool of the cell. Throws InputError `reserve_invalid` where that much cannot be reserved.
  PathTool(const Cell& cell, const PlanPath& path, double reserve_m);
  /// One of the plan's milling tools.
  PathTool(const Cell& cell, const PlanPath& path, const MillTool& tool, double reserve_m);
  PathTool(const PathTool&) = delete;
  PathTool& operator=(const PathTool&) = delete;

  const Cell cell;  ///< a milling tool is part of its tool link
  const Chain chain;
  const ToolRates rates;
  const StrayBound stray;
  /// What the tool itself takes at most.
  const double feed_m_s = std::numeric_limits<double>::infinity();
  const MillRoom room;
};

class PathTools {
 public:
  /// Throws as PathTool does.
  PathTools(const PlanPath& path, const Cell& cell, double reserve_m);

  /// That which is in the spindle on the way to a point. `path` must be the same.
  const PathTool& on_edge_to(const PlanPath& path, std::size_t point) const {
    return *tools_[path.edge_to(point).tool];
  }
  const PathTool& first() const { return *tools_.front(); }
  std::size_t size() const { return tools_.size(); }

 private:
  std::vector<std::unique_ptr<PathTool>> tools_;
};

}  // namespace sculpt
