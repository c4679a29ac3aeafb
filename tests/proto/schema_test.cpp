#include "proto/schema.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <vector>

#include "proto/error_codes.hpp"
#include "proto/messages.hpp"

namespace sculpt::proto {
namespace {

const std::string prefix = "#/$defs/";

// Every object of the document that is a schema, with its place.
void visit(const Json& schema, const std::string& place,
           const std::function<void(const Json&, const std::string&)>& see) {
  see(schema, place);
  for (const char* map : {"$defs", "properties"}) {
    if (!schema.contains(map)) continue;
    for (const auto& [name, part] : schema[map].items()) visit(part, place + "/" + name, see);
  }
  for (const char* list : {"oneOf", "anyOf", "allOf"}) {
    if (!schema.contains(list)) continue;
    for (const Json& part : schema[list]) visit(part, place + "/" + list, see);
  }
  for (const char* one : {"items", "if", "then", "else", "not", "propertyNames", "additionalProperties"}) {
    if (schema.contains(one) && schema[one].is_object()) visit(schema[one], place + "/" + one, see);
  }
}

std::set<std::string> references(const Json& schema) {
  std::set<std::string> found;
  visit(schema, "", [&](const Json& part, const std::string&) {
    if (part.contains("$ref")) found.insert(part["$ref"].get<std::string>().substr(prefix.size()));
  });
  return found;
}

std::set<std::string> names(const Json& definitions) {
  std::set<std::string> found;
  for (const auto& [name, definition] : definitions.items()) found.insert(name);
  return found;
}

TEST(Schema, ItsErrorsAreTheCatalogue) {
  Json words = Json::array(), numbers = Json::array();
  for (const ErrorCode& code : error_catalogue()) {
    words.push_back(code.word);
    numbers.push_back(code.number);
  }
  numbers.push_back(find_error("a word of the future").number);
  const Json definitions = protocol_schema()["$defs"];
  EXPECT_EQ(definitions["error_word"]["enum"], words);
  EXPECT_EQ(definitions["error_number"]["enum"], numbers);
}

TEST(Schema, ItIsOfThisVersionOfTheProtocol) {
  EXPECT_EQ(protocol_schema()["title"],
            "sculptd protocol " + std::to_string(protocol_major) + "." + std::to_string(protocol_minor));
}

TEST(Schema, EveryReferenceHasItsDefinitionAndEveryDefinitionIsUsed) {
  const Json whole = protocol_schema();
  const std::set<std::string> defined = names(whole["$defs"]);
  std::set<std::string> used = references(whole);
  for (const Json& method : whole["$defs"]["method"]["enum"]) used.insert(method.get<std::string>() + ".result");
  EXPECT_EQ(used, defined);
}

TEST(Schema, EveryObjectIsClosedAndEveryDefinitionSaysWhatItIs) {
  const Json whole = protocol_schema();
  const std::set<std::string> open{"/request/params", "/reply/result"};  // what may be there hangs on the method
  visit(whole, "", [&](const Json& schema, const std::string& place) {
    if (!schema.contains("type") || schema["type"] != "object" || open.contains(place)) return;
    if (place.starts_with("/server.schema.result/")) return;
    EXPECT_TRUE(schema.contains("additionalProperties")) << place;
  });
  for (const auto& [name, definition] : whole["$defs"].items()) {
    EXPECT_TRUE(definition.contains("description") || definition.contains("$ref")) << name;
  }
}

std::set<std::string> parts_of_their_own() {
  return protocol_schema()["$defs"]["schema_part"]["enum"].get<std::set<std::string>>();
}

// What is referred to, but for parts of their own.
std::set<std::string> needed_by(const Json& part) {
  std::set<std::string> used = references(part);
  for (const std::string& own : parts_of_their_own()) used.erase(own);
  return used;
}

TEST(Schema, APartOfItsOwnIsLeftOutAndAskedForByItself) {
  const Json whole = protocol_schema();
  for (const std::string& name : parts_of_their_own()) {
    const Json part = protocol_schema_part(name);
    std::set<std::string> used = needed_by(part);
    used.insert(name);
    EXPECT_EQ(used, names(part["$defs"])) << name;
    EXPECT_EQ(part["$defs"][name], whole["$defs"][name]);
  }
  EXPECT_FALSE(protocol_schema("job.report")["$defs"].contains("report_time"));
  EXPECT_THROW(protocol_schema_part("job_view"), ProtocolError);
}

TEST(Schema, APartIsWhatAMethodNeedsAndNoMore) {
  const Json whole = protocol_schema();
  for (const Json& method : whole["$defs"]["method"]["enum"]) {
    const Json part = protocol_schema(method);
    const std::set<std::string> defined = names(part["$defs"]);
    std::set<std::string> used = needed_by(part);
    used.insert({method.get<std::string>() + ".params", method.get<std::string>() + ".result"});
    EXPECT_EQ(used, defined) << method;
    for (const std::string& name : defined) EXPECT_EQ(part["$defs"][name], whole["$defs"][name]);
  }
  EXPECT_EQ(names(protocol_schema("ping")["$defs"]), (std::set<std::string>{"nothing", "ping.params", "ping.result"}));
}

TEST(Schema, APartOfNoMethodIsRefused) {
  for (const char* name : {"job.fly", "job_view", "job.get.params"}) {
    EXPECT_THROW(protocol_schema(name), ProtocolError) << name;
  }
}

}  // namespace
}  // namespace sculpt::proto
