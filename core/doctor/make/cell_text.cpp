// Cell -> the text of a cell file.
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/doctor/make/new_cell.hpp"

namespace sculpt {
namespace {

using Json = nlohmann::ordered_json;

/// Without what is left over from binary arithmetic.
double brief(double value) {
  return std::round(value * 1e6) / 1e6 + 0.0;
}

Json tool_json(const Cell& cell) {
  const ToolSpec& tool = cell.tool;
  const std::string unit = tool.in_voxels ? "_radius_voxels" : "_radius_m";
  Json json{{"link", cell.robot.links[static_cast<std::size_t>(cell.tool_link)].name},
            {"stickout_m", brief(tool.stickout_m)},
            {"ball" + unit, brief(tool.ball_radius)},
            {"shank" + unit, brief(tool.shank_radius)}};
  for (const HolderSection& section : tool.holder)
    json["holder"].push_back(
        {{"length_m", section.length_m}, {"radius_m", section.radius_m}, {"end_radius_m", section.end_radius_m}});
  return json;
}

}  // namespace

std::string cell_text(const Cell& cell, const std::string& urdf, const std::map<std::string, std::string>& packages) {
  const Vec3& origin = cell.stock_origin_m;
  Json json{{"urdf", urdf}};
  if (!packages.empty()) json["packages"] = packages;
  json["stock"] = {{"link", cell.robot.links[static_cast<std::size_t>(cell.stock_link)].name},
                   {"size_m", brief(cell.stock_size_m)},
                   {"origin_m", {brief(origin.x()), brief(origin.y()), brief(origin.z())}}};
  json["tool"] = tool_json(cell);
  json["home"] = Json::object();
  for (std::size_t j = 0; j < cell.robot.joints.size(); ++j) {
    const Joint& joint = cell.robot.joints[j];
    if (joint.kind != JointKind::fixed && joint.mimic < 0) json["home"][joint.name] = brief(cell.rest[j]);
  }
  const auto link = [&](int number) { return cell.robot.links[static_cast<std::size_t>(number)].name; };
  for (const auto& [first, second] : cell.ignore_pairs) json["ignore_pairs"].push_back({link(first), link(second)});
  return json.dump(2) + "\n";
}

}  // namespace sculpt
