// The methods that the server has are those of its schema.
#include "proto/schema.hpp"

#include <gtest/gtest.h>

#include <set>

#include "server/api/methods.hpp"

namespace sculpt::server {
namespace {

Json methods_of_the_table() {
  Json methods = Json::array();
  for (const Method& method : server::methods()) methods.push_back(method.name);
  return methods;
}

TEST(Schema, ItHasTheMethodsOfTheTable) {
  EXPECT_EQ(proto::protocol_schema()["$defs"]["method"]["enum"], methods_of_the_table());
}

TEST(Schema, EveryMethodHasARequestWithItsParams) {
  Json methods = Json::array();
  const Json whole = proto::protocol_schema();
  for (const Json& request : whole["$defs"]["request"]["oneOf"]) {
    const std::string method = request["properties"]["method"]["const"];
    EXPECT_EQ(request["properties"]["params"]["$ref"], "#/$defs/" + method + ".params");
    methods.push_back(method);
  }
  EXPECT_EQ(methods, methods_of_the_table());
}

TEST(Schema, EveryMethodHasParamsAndAResultAndNothingElseHas) {
  std::set<std::string> wanted, found;
  for (const Method& method : methods())
    wanted.insert({std::string(method.name) + ".params", std::string(method.name) + ".result"});
  const Json whole = proto::protocol_schema();
  for (const auto& [name, definition] : whole["$defs"].items()) {
    if (name.ends_with(".params") || name.ends_with(".result")) found.insert(name);
  }
  EXPECT_EQ(found, wanted);
}

}  // namespace
}  // namespace sculpt::server
