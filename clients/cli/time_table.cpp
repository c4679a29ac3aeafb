#include "clients/cli/time_table.hpp"

#include <cstdio>

namespace sculpt::cli {

namespace {

Json by_joint(const PlanPath& path, const std::vector<double>& seconds) {
  Json object = Json::object();
  for (std::size_t at = 0; at < seconds.size(); ++at) object[path.header().joints[at]] = seconds[at];
  return object;
}

std::string row(const std::string& label, double seconds, double total) {
  char text[128];
  std::snprintf(text, sizeof text, "%-24s %12.1f s  %6.2f %%\n", label.c_str(), seconds, 100 * seconds / total);
  return text;
}

}  // namespace

Json time_report(const PlanPath& path, const TimedPlan& plan) {
  Json worst = Json::array();
  for (const SlowPlace& place : plan.worst)
    worst.push_back({{"keyframe", place.keyframe},
                     {"voxel", {place.voxel.i, place.voxel.j, place.voxel.k}},
                     {"joint", place.joint},
                     {"feed_m_s", place.feed_m_s}});
  const TimeAccount& time = plan.time;
  Json tools = Json::array();
  for (std::size_t at = 0; at < time.tools.size(); ++at)
    tools.push_back({{"name", path.header().mill->tools[at].name}, {"seconds", time.tools[at]}});
  const Json by{{"feed", time.feed},
                {"rapid", time.rapid},
                {"velocity", by_joint(path, time.velocity)},
                {"acceleration", by_joint(path, time.acceleration)},
                {"jerk", by_joint(path, time.jerk)}};
  Json figures{{"total_s", time.total},
               {"ratio", time.at_caps > 0 ? time.total / time.at_caps : 1},
               {"window_s", plan.law.window_s},
               {"feed_m_s", plan.law.feed_m_s},
               {"rapid_m_s", plan.law.rapid_m_s},
               {"keyframes", path.keyframes()},
               {"by", by},
               {"worst", worst}};
  if (!tools.empty()) figures["tools"] = std::move(tools);
  return {{"time", std::move(figures)}};
}

std::string time_table(const Json& report) {
  const Json& time = report.at("time");
  const double total = time.at("total_s");
  char head[160];
  const auto seconds = static_cast<long long>(total);
  std::snprintf(head, sizeof head, "%lld:%02lld:%02lld h (%.1f s), %.3f of what the caps alone would take\n",
                seconds / 3600, seconds / 60 % 60, seconds % 60, total, time.at("ratio").get<double>());
  std::string table = head;
  if (time.contains("tools"))
    for (const Json& tool : time.at("tools"))
      table += row("with " + tool.at("name").get<std::string>(), tool.at("seconds"), total);
  for (const char* cause : {"feed", "rapid"}) table += row(cause, time.at("by").at(cause), total);
  for (const char* cause : {"velocity", "acceleration", "jerk"})
    for (const auto& [joint, value] : time.at("by").at(cause).items())
      if (value.get<double>() > 0.0005 * total) table += row(std::string(cause) + " of " + joint, value, total);
  for (const Json& place : time.at("worst")) {
    char text[160];
    std::snprintf(text, sizeof text, "slowest: keyframe %llu  %8.2f mm/s  ",
                  static_cast<unsigned long long>(place.at("keyframe").get<std::uint64_t>()),
                  1000 * place.at("feed_m_s").get<double>());
    table += text + place.at("joint").get<std::string>() + "\n";
  }
  return table;
}

}  // namespace sculpt::cli
