#include "core/plan/checkpoint/mill_json.hpp"

#include <algorithm>

#include "core/plan/checkpoint/path_json.hpp"

namespace sculpt {
namespace {

using Json = nlohmann::json;

Json tools_json(const std::vector<ToolFigures>& tools) {
  Json json = Json::array();
  for (const ToolFigures& tool : tools)
    json.push_back({{"name", tool.name},
                    {"removed", tool.removed},
                    {"keyframes", tool.keyframes},
                    {"runs", tool.runs},
                    {"removed_m3", tool.removed_m3},
                    {"cut_m", tool.cut_m},
                    {"travel_m", tool.travel_m},
                    {"engagement", {tool.engagement.mean, tool.engagement.largest}}});
  return json;
}

std::vector<ToolFigures> tools_of(const Json& json) {
  std::vector<ToolFigures> tools;
  for (const Json& tool : json)
    tools.push_back({tool.at("name").get<std::string>(),
                     tool.at("removed").get<std::uint64_t>(),
                     tool.at("keyframes").get<std::uint64_t>(),
                     tool.at("runs").get<std::uint64_t>(),
                     tool.at("removed_m3").get<double>(),
                     tool.at("cut_m").get<double>(),
                     tool.at("travel_m").get<double>(),
                     {tool.at("engagement").at(0).get<double>(), tool.at("engagement").at(1).get<double>()}});
  return tools;
}

Json cures_json(const std::vector<Cure>& cures) {
  Json json = Json::array();
  for (const Cure& cure : cures)
    json.push_back({static_cast<int>(cure.obstacle), cure.diameter_m, cure.free_m, cure.share, cure.resolution});
  return json;
}

std::vector<Cure> cures_of(const Json& json) {
  std::vector<Cure> cures;
  for (const Json& cure : json)
    cures.push_back({static_cast<Obstacle>(cure.at(0).get<int>()), cure.at(1).get<double>(), cure.at(2).get<double>(),
                     cure.at(3).get<double>(), cure.at(4).get<int>()});
  return cures;
}

/// A digit for each nail: there may be hundreds of thousands.
std::string digits(std::vector<char> flags) {
  for (char& flag : flags) flag = static_cast<char>(flag + '0');
  return {flags.begin(), flags.end()};
}

std::vector<char> flags_of(const std::string& digits) {
  std::vector<char> flags(digits.begin(), digits.end());
  for (char& flag : flags) flag = static_cast<char>(flag - '0');
  return flags;
}

}  // namespace

Json milling_json(const MillMemory& milling) {
  Json ways = Json::array();
  for (const auto& [direction, way] : milling.arm.ways) ways.push_back({direction, path_json(way)});
  return {{"tools", tools_json(milling.tools)},
          {"ways", std::move(ways)},
          {"searched", milling.arm.searched},
          {"transits", milling.arm.transits},
          {"reachable", digits(milling.reachable)}};
}

MillMemory milling_of(const Json& json) {
  MillMemory milling;
  milling.tools = tools_of(json.at("tools"));
  for (const Json& way : json.at("ways")) milling.arm.ways[way.at(0).get<int>()] = path_of(way.at(1));
  milling.arm.searched = json.at("searched").get<std::set<int>>();
  milling.arm.transits = json.at("transits").get<std::uint64_t>();
  milling.reachable = flags_of(json.at("reachable").get<std::string>());
  return milling;
}

Json milled_json(const MilledFigures& milled) {
  const ExcessFigures& reachable = milled.reachable;
  return {{"tools", tools_json(milled.tools)},
          {"cures", cures_json(milled.cures)},
          {"points", {reachable.points, reachable.within_tolerance}},
          {"excess_m", {reachable.p50_m, reachable.p95_m, reachable.p99_m, reachable.max_m}}};
}

MilledFigures milled_of(const Json& json) {
  const Json &points = json.at("points"), &excess = json.at("excess_m");
  return {tools_of(json.at("tools")),
          cures_of(json.at("cures")),
          {points.at(0).get<std::uint64_t>(), points.at(1).get<std::uint64_t>(), excess.at(0).get<double>(),
           excess.at(1).get<double>(), excess.at(2).get<double>(), excess.at(3).get<double>()}};
}

}  // namespace sculpt
