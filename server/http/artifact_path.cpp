#include "server/http/artifact_path.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace sculpt::server {
namespace {

constexpr std::array numbers{"part_keyframes", "part_bytes", "stock_files", "seams_in_stock"};
constexpr std::array speeds{"feed_m_s", "rapid_m_s", "keep_feed"};

[[noreturn]] void refuse(const std::string& field, const std::string& why) {
  throw proto::ProtocolError("params_invalid", "'" + field + "' behind an artifact's path " + why);
}

Json read_value(const std::string& field, const std::string& value) try {
  return proto::parse_json(value);
} catch (const proto::JsonError&) {
  refuse(field, "must be a number, or true or false, not '" + value + "'");
}

void take_field(const std::string& field, const std::string& value, Json& params) {
  const bool of_program = params.contains("program");
  Json& program = params["program"];
  if (field == "format")
    params[field] = value;
  else if (!of_program)
    refuse(field, "means nothing: only format may be there");
  else if (field == "dialect" || field == "name")
    program[field] = value;
  else if (std::ranges::find(numbers, field) != numbers.end())
    program[field] = read_value(field, value);
  else if (std::ranges::find(speeds, field) != speeds.end())
    program["motion"][field] = read_value(field, value);
  else
    refuse(field,
           "is not known: a program has dialect, name, feed_m_s, rapid_m_s, keep_feed, part_keyframes, "
           "part_bytes, stock_files and seams_in_stock");
  if (!of_program) params.erase("program");
}

}  // namespace

proto::ArtifactReadParams read_artifact_path(std::string_view path) {
  const std::size_t query = std::min(path.find('?'), path.size()), slash = path.find('/');
  if (slash > query)
    throw proto::ProtocolError("not_found", "an artifact's path is /v1/artifacts/JOB/NAME[?format=FORMAT]");
  Json params{{"job", path.substr(0, slash)}, {"artifact", path.substr(slash + 1, query - slash - 1)}};
  if (params["artifact"] == "program") params["program"] = Json::object();
  for (std::string_view rest = path.substr(std::min(query + 1, path.size())); !rest.empty();) {
    const std::string_view one = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(one.size() + 1, rest.size()));
    const std::size_t middle = std::min(one.find('='), one.size());
    take_field(std::string(one.substr(0, middle)), std::string(one.substr(std::min(middle + 1, one.size()))), params);
  }
  return proto::read_artifact_link(params);
}

}  // namespace sculpt::server
