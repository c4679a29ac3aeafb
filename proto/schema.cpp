#include "proto/schema.hpp"

#include <algorithm>
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

bool is_part(const std::string& name) {
  const Json& parts = document().at("$defs").at("schema_part").at("enum");
  return std::find(parts.begin(), parts.end(), name) != parts.end();
}

std::set<std::string> reached_from(std::vector<std::string> open) {
  std::set<std::string> reached;
  const std::set<std::string> wanted(open.begin(), open.end());
  while (!open.empty()) {
    const std::string name = std::move(open.back());
    open.pop_back();
    if (is_part(name) && !wanted.contains(name)) continue;
    if (reached.insert(name).second) add_references(document().at("$defs").at(name), open);
  }
  return reached;
}

Json document_of(const std::vector<std::string>& names) {
  const std::set<std::string> needed = reached_from(names);
  Json part{{"$schema", document().at("$schema")}, {"$defs", Json::object()}};
  for (const auto& [name, definition] : document().at("$defs").items()) {
    if (needed.contains(name)) part["$defs"][name] = definition;
  }
  return part;
}

}  // namespace

Json protocol_schema(const std::string& method) {
  if (method.empty()) return document();
  if (!document().at("$defs").contains(method + ".params")) {
    throw ProtocolError("params_invalid", "there is no method '" + method + "'; without one you get the whole schema",
                        "/params/method");
  }
  return document_of({method + ".params", method + ".result"});
}

Json protocol_schema_part(const std::string& part) {
  if (!is_part(part)) {
    throw ProtocolError("params_invalid", "there is no part '" + part + "'; schema_part lists those that there are",
                        "/params/part");
  }
  return document_of({part});
}

}  // namespace sculpt::proto
