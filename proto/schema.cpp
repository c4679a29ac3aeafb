#include "proto/schema.hpp"

#include <set>
#include <vector>

#include "proto/error_codes.hpp"

namespace sculpt::proto {
namespace {

constexpr std::string_view definitions_path = "#/$defs/";

const Json& document() {
  static const Json whole = parse_json(schema_text());
  return whole;
}

void add_references(const Json& schema, std::vector<std::string>& names) {
  for (const auto& [key, value] : schema.items()) {
    if (key == "$ref") {
      names.push_back(value.get<std::string>().substr(definitions_path.size()));
    } else if (value.is_structured()) {
      add_references(value, names);
    }
  }
}

std::set<std::string> reached_from(std::vector<std::string> open) {
  std::set<std::string> reached;
  while (!open.empty()) {
    const std::string name = std::move(open.back());
    open.pop_back();
    if (reached.insert(name).second) add_references(document().at("$defs").at(name), open);
  }
  return reached;
}

}  // namespace

Json protocol_schema(const std::string& method) {
  if (method.empty()) return document();
  const Json& all = document().at("$defs");
  if (!all.contains(method + ".params")) {
    throw ProtocolError("params_invalid", "there is no method '" + method + "'; without one you get the whole schema",
                        "/params/method");
  }
  const std::set<std::string> needed = reached_from({method + ".params", method + ".result"});
  Json part{{"$schema", document().at("$schema")}, {"$defs", Json::object()}};
  for (const auto& [name, definition] : all.items()) {
    if (needed.contains(name)) part["$defs"][name] = definition;
  }
  return part;
}

}  // namespace sculpt::proto
