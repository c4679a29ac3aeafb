#include "core/timing/stop_times.hpp"

#include <algorithm>
#include <cmath>

#include "core/timing/edge.hpp"

namespace sculpt {

void for_each_stop(const PlanPath& path, const Chain& chain, const MotionLimits& limits, const Feeds& feeds,
                   const std::function<void(std::size_t point, const StopTime&)>& take) {
  const ToolRates rates(chain);
  EdgePlaces places;
  places[2].put(rates, path.configuration(0));
  for (std::size_t point = 1; point < path.size(); ++point) {
    places[0] = places[2];
    const PathEdge edge = make_edge(rates, {limits.acceleration, limits.velocity}, path.configuration(point - 1),
                                    path.configuration(point), places);
    const double feed = path.edge_to(point).voxels > 0 ? feeds.feed_m_s : feeds.rapid_m_s,
                 cap = 1 / std::max(edge.joint_rate, edge.ball / feed), a = edge.line_acceleration,
                 peak = std::min(cap, std::sqrt(a * edge.length));
    take(point, {edge.length / peak + peak / a, peak * edge.joint_rate});
  }
}

}  // namespace sculpt
