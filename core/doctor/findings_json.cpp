#include "core/doctor/findings_json.hpp"

#include <nlohmann/json.hpp>

namespace sculpt {
namespace {

using Json = nlohmann::ordered_json;

const char* name(JointKind kind) {
  return kind == JointKind::prismatic ? "shifts" : "turns";
}

const char* name(Fault::Weight weight) {
  return weight == Fault::Weight::error ? "error" : weight == Fault::Weight::warning ? "warning" : "note";
}

Json to_json(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

Json to_json(const JointFinding& joint) {
  return {{"name", joint.name},          {"kind", name(joint.kind)},
          {"lower", joint.lower},        {"upper", joint.upper},
          {"home", joint.home},          {"carries", joint.carries_stock ? "stock" : "tool"},
          {"followers", joint.followers}};
}

Json to_json(const IdleJoint& joint) {
  return {{"name", joint.name},
          {"kind", name(joint.kind)},
          {"link", joint.child_link},
          {"at", joint.at},
          {"rides_on_the_arm", joint.rides_on_the_arm}};
}

Json to_json(const BodyFinding& body) {
  return {{"link", body.link},
          {"shapes", body.shapes},
          {"facets", body.facets},
          {"size_m", to_json(body.size_m)},
          {"moved_by", body.moved_by}};
}

Json to_json(const PairFinding& pair) {
  return Json::array({pair.first, pair.second});
}

Json with_gap(const PairFinding& pair) {
  return {{"bodies", to_json(pair)}, {"gap_m", pair.gap_m}};
}

Json to_json(const HomeFinding& home) {
  Json json{{"free", home.blocking.empty()}, {"ball_m", to_json(home.ball_m)}, {"axis", to_json(home.axis)}};
  json["blocking"] = Json::array();
  for (const PairFinding& pair : home.blocking) json["blocking"].push_back(with_gap(pair));
  if (home.nearest) json["nearest"] = with_gap(*home.nearest);
  return json;
}

Json to_json(const DirectionFinding& direction) {
  Json json{{"name", direction.name},
            {"axis", to_json(direction.axis)},
            {"places", direction.places},
            {"free", direction.free},
            {"blocked", direction.blocked},
            {"beyond_limits", direction.beyond_limits},
            {"out_of_reach", direction.out_of_reach},
            {"field", direction.field}};
  json["blockers"] = Json::array();
  for (const auto& [pair, places] : direction.blockers)
    json["blockers"].push_back({{"bodies", to_json(pair)}, {"places", places}});
  return json;
}

Json to_json(const Fault& fault) {
  return {{"weight", name(fault.weight)}, {"code", fault.code}, {"sentence", fault.sentence}, {"cure", fault.cure}};
}

template <typename All>
Json list(const All& all) {
  Json json = Json::array();
  for (const auto& each : all) json.push_back(to_json(each));
  return json;
}

}  // namespace

std::string findings_json(const CellFindings& found) {
  Json json{{"cell", found.name},
            {"plannable", found.plannable()},
            {"resolution", found.resolution},
            {"stock_link", found.stock_link},
            {"tool_link", found.tool_link},
            {"chain", list(found.chain)},
            {"idle_joints", list(found.idle_joints)},
            {"bodies", list(found.bodies)},
            {"checked_pairs", list(found.checked_pairs)}};
  json["unchecked_links"] = Json::array();
  for (const PairFinding& pair : found.unchecked_pairs)
    json["unchecked_links"].push_back({{"links", to_json(pair)}, {"why", pair.why}});
  json["stock_size_m"] = found.stock_size_m;
  json["tool"] = {
      {"stickout_m", found.stickout_m}, {"free_m", found.free_length_m}, {"ball_radius_m", found.ball_radius_m}};
  json["home"] = to_json(found.home);
  if (found.better_home) json["better_home"] = *found.better_home;
  json["reached"] = found.reached;
  json["directions"] = list(found.directions);
  json["seconds"] = {{"scene", found.scene_s}, {"fields", found.fields_s}, {"fields_kept", found.fields_kept}};
  json["faults"] = list(found.faults);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);  // names may be no UTF-8
}

}  // namespace sculpt
