#include "core/plan/report.hpp"

#include <nlohmann/json.hpp>

namespace sculpt {
namespace {

nlohmann::ordered_json json_of(const ExcessFigures& figures) {
  return {
      {"points", figures.points},
      {"within_tolerance", figures.within_tolerance},
      {"excess_m", {{"p50", figures.p50_m}, {"p95", figures.p95_m}, {"p99", figures.p99_m}, {"max", figures.max_m}}}};
}

}  // namespace

std::string report_json(const Report& report) {
  using Json = nlohmann::ordered_json;
  Json residue = Json::array();
  for (const auto& [reason, voxels] : report.residue) residue.push_back({{"reason", name(reason)}, {"voxels", voxels}});
  Json unchecked = Json::array();
  for (const auto& [first, second, why] : report.unchecked_links)
    unchecked.push_back({{"links", {first, second}}, {"why", why}});
  Json exempt = Json::array();
  for (const ExemptPair& pair : report.verify.exempt_pairs)
    exempt.push_back({{"links", {pair.first, pair.second}}, {"why", pair.why}});
  const auto& v = report.voxels;
  const auto& p = report.path;
  const auto& q = report.quality;
  const auto& s = report.seconds;
  Json json{{"mesh", report.mesh},
            {"robot", report.robot},
            {"search", report.search},
            {"seed", report.seed},
            {"resolution", report.resolution},
            {"voxels",
             {{"total", v.total},
              {"air", v.air},
              {"keep", v.keep},
              {"remove", v.remove},
              {"removed", v.removed},
              {"residue", v.residue},
              {"loose_keep", v.loose_keep},
              {"loose_keep_pieces", v.loose_keep_pieces},
              {"freed", v.freed},
              {"ambiguous", v.ambiguous}}},
            {"residue", residue},
            {"octree", {{"leaves", report.octree.leaves}, {"remove_leaves", report.octree.remove_leaves}}},
            {"path",
             {{"keyframes", p.keyframes},
              {"rows", p.rows},
              {"transits", p.transits},
              {"cut_m", p.cut_m},
              {"travel_m", p.travel_m},
              {"joint_travel_rad", p.joint_travel_rad}}},
            {"quality",
             {{"moves_per_voxel", q.moves_per_voxel},
              {"checks_per_voxel", q.checks_per_voxel},
              {"turns", q.turns},
              {"ompl_calls", q.ompl_calls},
              {"ompl_solved", q.ompl_solved}}},
            {"seconds",
             {{"load", s.load},
              {"voxelize", s.voxelize},
              {"octree", s.octree},
              {"plan", s.plan},
              {"verify", s.verify},
              {"total", s.total}}},
            {"unchecked_links", unchecked},
            {"peak_memory_bytes", report.peak_memory_bytes},
            {"threads", report.threads},
            {"plan_sha256", report.plan_sha256},
            {"verify",
             {{"clean", report.verify.clean},
              {"collisions", report.verify.collisions},
              {"voxels_checked", report.verify.voxels_checked},
              {"findings", report.findings},
              {"exempt_pairs", exempt}}}};
  if (const auto& sweep = report.sweep)
    json["sweep"] = {{"cut", sweep->cut}, {"left", sweep->left}, {"uncovered", sweep->uncovered}};
  for (const ToolFigures& tool : report.tools)
    json["tools"].push_back({{"name", tool.name},
                             {"removed_m3", tool.removed_m3},
                             {"cut_m", tool.cut_m},
                             {"travel_m", tool.travel_m},
                             {"keyframes", tool.keyframes},
                             {"runs", tool.runs},
                             {"engagement", {{"mean", tool.engagement.mean}, {"max", tool.engagement.largest}}}});
  for (const Cure& cure : report.cures)
    json["cures"].push_back({{"obstacle", name(cure.obstacle)},
                             {"share", cure.share},
                             {"diameter_m", cure.diameter_m},
                             {"free_m", cure.free_m},
                             {"cure", cure.sentence()}});
  if (const auto& surface = report.surface) {
    json["surface"] = json_of(surface->all);
    json["surface"]["reachable"] = json_of(surface->reachable);
    json["surface"]["base_points"] = surface->base_points;
    json["surface"]["gouged_points"] = surface->gouged_points;
    json["surface"]["gouge_m"] = surface->gouge_m;
  }
  if (report.time) json["time"] = Json::parse(time_json(*report.time));
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string residue_ndjson(const std::vector<Residue>& residue) {
  std::string text;
  for (const Residue& left : residue)
    text += "{\"voxel\":[" + std::to_string(left.voxel.i) + "," + std::to_string(left.voxel.j) + "," +
            std::to_string(left.voxel.k) + "],\"reason\":\"" + name(left.reason) + "\"}\n";
  return text;
}

}  // namespace sculpt
