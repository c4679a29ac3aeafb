// Where a law is slower than the feed that was asked for.
#pragma once

#include <string>
#include <vector>

#include "core/law/time_law.hpp"
#include "core/timing/demand/motion_demands.hpp"
#include "core/timing/path_tool.hpp"

namespace sculpt {

/// A cut that is slower than the feed.
struct SlowPlace {
  std::uint64_t keyframe = 0;  ///< from 1
  Voxel voxel;                 ///< that is cut there, or the last of them; that a milling tool's tip is in
  std::string joint;           ///< whose acceleration is in the way
  double feed_m_s = 0;         ///< that is kept there
};

/// Of all edges that cut, but for the first and last voxel of cuts along one line, and the first and last edge of a
/// milling tool's run: the slowest ten. Throws InputError
/// `feed_not_kept` with the first that is slower than `keep_feed` allows.
std::vector<SlowPlace> find_slow_places(const PlanPath& path, const PathTools& tools, const Configuration& velocity,
                                        const TimeLaw& law, const MotionDemands& demands);

}  // namespace sculpt
