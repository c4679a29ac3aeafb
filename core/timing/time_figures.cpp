#include "core/timing/time_figures.hpp"

#include <nlohmann/json.hpp>

namespace sculpt {
namespace {

using Json = nlohmann::ordered_json;

Json by_name(const std::vector<std::string>& names, const std::vector<double>& seconds) {
  Json object = Json::object();
  for (std::size_t at = 0; at < seconds.size(); ++at) object[names[at]] = seconds[at];
  return object;
}

}  // namespace

TimeFigures time_figures(const PlanPath& path, const TimedPlan& plan) {
  TimeFigures figures{
      plan.time, plan.law.window_s, plan.law.feed_m_s, plan.law.rapid_m_s, path.keyframes(), path.header().joints,
      {},        plan.worst};
  if (path.header().mill)
    for (const MillTool& tool : path.header().mill->tools) figures.tools.push_back(tool.name);
  return figures;
}

std::string time_json(const TimeFigures& figures) {
  const TimeAccount& time = figures.time;
  Json worst = Json::array();
  for (const SlowPlace& place : figures.worst)
    worst.push_back({{"keyframe", place.keyframe},
                     {"voxel", {place.voxel.i, place.voxel.j, place.voxel.k}},
                     {"joint", place.joint},
                     {"feed_m_s", place.feed_m_s}});
  Json json{{"total_s", time.total},
            {"ratio", figures.ratio()},
            {"window_s", figures.window_s},
            {"feed_m_s", figures.feed_m_s},
            {"rapid_m_s", figures.rapid_m_s},
            {"keyframes", figures.keyframes},
            {"by",
             {{"feed", time.feed},
              {"rapid", time.rapid},
              {"velocity", by_name(figures.joints, time.velocity)},
              {"acceleration", by_name(figures.joints, time.acceleration)},
              {"jerk", by_name(figures.joints, time.jerk)}}},
            {"worst", worst}};
  for (std::size_t at = 0; at < time.tools.size(); ++at)
    json["tools"].push_back({{"name", figures.tools[at]}, {"seconds", time.tools[at]}});
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace sculpt
