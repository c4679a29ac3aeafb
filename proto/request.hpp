// Lines <-> requests, replies and events (JSON-RPC 2.0 as proto/PROTOCOL.md section 2 narrows it).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "proto/error_codes.hpp"

namespace sculpt::proto {

/// One request line. `id` is a string or an integer, or null when the line was too broken to have one.
struct Request {
  Json id;
  std::string method;
  Json params = Json::object();
};

/// Either a request, or why the line is none, with the id to answer under.
struct ParsedLine {
  Request request;
  std::optional<ProtocolError> error;
};

/// Never throws.
ParsedLine parse_request(std::string_view line);

/// Size of the chunk behind this request line: set only for `blob.put`. Throws ProtocolError `bad_request` when `bytes`
/// cannot be used, so that nobody knows where the next line begins.
std::optional<std::size_t> announced_chunk(const Request& request);

// Each without LF.
std::string request_line(const Json& id, const std::string& method, const Json& params);
std::string reply_line(const Json& id, const Json& result);
std::string error_line(const Json& id, const Json& error_object);
/// At most `max_line` bytes of it: its sentence is cut, then its pointer is left out.
std::string fitted_error_line(const Json& id, Json error_object, std::size_t max_line);
std::string event_line(const Json& params);

}  // namespace sculpt::proto
