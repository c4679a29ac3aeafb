// Where a law is slower than the feed that was asked for.
#pragma once

#include <string>
#include <vector>

#include "core/cell/chain.hpp"
#include "core/law/time_law.hpp"
#include "core/timing/motion_demands.hpp"
#include "core/timing/plan_path.hpp"

namespace sculpt {

/// A cut that is slower than the feed.
struct SlowPlace {
  std::uint64_t keyframe = 0;  ///< from 1
  Voxel voxel;                 ///< that is cut there, or the last of them
  std::string joint;           ///< whose acceleration is in the way
  double feed_m_s = 0;         ///< that is kept there
};

/// Of all edges that cut, but for the first and last voxel of cuts along one line: the slowest ten. Throws InputError
/// `feed_not_kept` with the first that is slower than `keep_feed` allows.
std::vector<SlowPlace> find_slow_places(const PlanPath& path, const Chain& chain, const Configuration& velocity,
                                        const TimeLaw& law, const MotionDemands& demands);

}  // namespace sculpt
