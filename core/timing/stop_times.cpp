#include "core/timing/stop_times.hpp"

#include <algorithm>
#include <cmath>

#include "core/timing/edge.hpp"

namespace sculpt {

StopTime stop_time(const PathTool& tool, const MotionLimits& limits, double feed_m_s, const Configuration& from,
                   const Configuration& to, EdgePlaces& places) {
  const PathEdge edge = make_edge(tool.rates, {limits.acceleration, limits.velocity}, from, to, places);
  const double cap = 1 / std::max(edge.joint_rate, edge.ball / feed_m_s), a = edge.line_acceleration,
               peak = std::min(cap, std::sqrt(a * edge.length));
  return {edge.length / peak + peak / a, peak * edge.joint_rate};
}

void for_each_stop(const PlanPath& path, const PathTools& tools, const MotionLimits& limits, const Feeds& feeds,
                   const std::function<void(std::size_t point, const StopTime&)>& take) {
  EdgePlaces places;
  for (std::size_t point = 1; point < path.size(); ++point) {
    const PathTool& tool = tools.on_edge_to(path, point);
    const bool is_same = point > 1 && path.edge_to(point).tool == path.edge_to(point - 1).tool;
    if (is_same)
      places.begin = places.end;
    else
      places.begin.put(tool.rates, path.configuration(point - 1));
    take(point, stop_time(tool, limits, feeds.of(path.edge_to(point), tool), path.configuration(point - 1),
                          path.configuration(point), places));
  }
}

}  // namespace sculpt
