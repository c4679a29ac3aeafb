// proto/schema.json, the protocol as a JSON Schema, inside the program.
#pragma once

#include <string>
#include <string_view>

#include "proto/json.hpp"

namespace sculpt::proto {

/// The file as it is.
std::string_view schema_text();

/// The document; with a method of it only METHOD.params, METHOD.result and the definitions that they refer to, but
/// those that `schema_part` lists. Throws ProtocolError `params_invalid` if there is no such method.
Json protocol_schema(const std::string& method = {});
/// Of the document one that `schema_part` lists, and in the same way what it refers to. Throws the same.
Json protocol_schema_part(const std::string& part);

}  // namespace sculpt::proto
