#include "server/run/inheritance.hpp"

namespace sculpt::server {

std::string inherited_text(const proto::JobSpec& spec, const proto::ClampingSpec& next) {
  proto::JobSpec first = spec;
  first.continued.reset();
  std::vector<proto::ClampingSpec> clampings = spec.clampings;
  clampings.push_back(next);
  Json list = Json::array();
  for (const proto::ClampingSpec& clamping : clampings)
    list.push_back({{"left", clamping.left}, {"rotation_rad", clamping.rotation_rad}});
  return proto::write_json({{"first", to_json(first)}, {"clampings", std::move(list)}});
}

void read_inherited(const std::string& text, proto::JobSpec& spec) {
  const Json json = proto::parse_json(text);
  const proto::JobSpec first = proto::read_job_spec(proto::Fields(json.at("first"), "/first"));
  spec.placement = first.placement;
  spec.stock_box = first.stock_box;
  spec.stock_mesh = first.stock_mesh;
  for (const Json& clamping : json.at("clampings"))
    spec.clampings.push_back({clamping.at("left"), clamping.at("rotation_rad")});
}

}  // namespace sculpt::server
