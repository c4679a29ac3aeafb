// The methods of proto/PROTOCOL.md.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "server/access/tokens.hpp"

namespace sculpt::server {

struct Method {
  std::string_view name;
  Scope scope = Scope::admin;  ///< that a caller needs
};

/// All, in the order of PROTOCOL.md.
std::span<const Method> methods();
/// Throws ProtocolError `unknown_method`.
const Method& find_method(const std::string& name);

}  // namespace sculpt::server
