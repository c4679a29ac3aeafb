#include "clients/cli/time_table.hpp"

#include <cstdio>

#include "core/timing/time_figures.hpp"

namespace sculpt::cli {

namespace {

std::string row(const std::string& label, double seconds, double total) {
  char text[128];
  std::snprintf(text, sizeof text, "%-24s %12.1f s  %6.2f %%\n", label.c_str(), seconds, 100 * seconds / total);
  return text;
}

}  // namespace

Json time_report(const PlanPath& path, const TimedPlan& plan) {
  return {{"time", proto::parse_json(time_json(time_figures(path, plan)))}};
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
