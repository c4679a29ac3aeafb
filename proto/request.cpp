#include "proto/request.hpp"

#include "proto/fields.hpp"
#include "proto/framing.hpp"

namespace sculpt::proto {
namespace {

constexpr std::size_t max_id_bytes = 128;

Json read_id(const Json& line) {
  const auto id = line.find("id");
  if (id == line.end()) throw ProtocolError("bad_request", "the request has no \"id\": give each request its own");
  const bool usable =
      id->is_number_integer() || (id->is_string() && id->get_ref<const std::string&>().size() <= max_id_bytes);
  if (!usable) throw ProtocolError("bad_request", "\"id\" must be an integer or a string of at most 128 bytes", "/id");
  return *id;
}

std::string read_method(const Json& line) {
  const auto method = line.find("method");
  if (method == line.end() || !method->is_string()) {
    throw ProtocolError("bad_request", "the request has no \"method\", or it is not a string", "/method");
  }
  return *method;
}

void check_rest(const Json& line) {
  const auto version = line.find("jsonrpc");
  if (version != line.end() && *version != "2.0") {
    throw ProtocolError("bad_request", "\"jsonrpc\" must be \"2.0\"", "/jsonrpc");
  }
  const auto params = line.find("params");
  if (params != line.end() && !params->is_object()) {
    throw ProtocolError("bad_request", "\"params\" must be an object", "/params");
  }
  for (const auto& [field, value] : line.items()) {
    if (field != "jsonrpc" && field != "id" && field != "method" && field != "params") {
      throw ProtocolError(
          "bad_request", "the request has an unknown field \"" + field + "\": allowed are jsonrpc, id, method, params");
    }
  }
}

}  // namespace

ParsedLine parse_request(std::string_view line) {
  ParsedLine parsed;
  try {
    Json json = parse_json(line);
    if (!json.is_object()) throw ProtocolError("bad_request", "a request must be a JSON object");
    parsed.request.id = read_id(json);
    parsed.request.method = read_method(json);
    // Before anything else is refused: a chunk may follow, and only params.bytes says how long it is.
    if (const auto params = json.find("params"); params != json.end()) parsed.request.params = *params;
    check_rest(json);
  } catch (const JsonError& error) {
    parsed.error = ProtocolError("parse_error", error.what());
  } catch (const ProtocolError& error) {
    parsed.error = error;
  }
  return parsed;
}

std::optional<std::size_t> announced_chunk(const Request& request) {
  if (request.method != "blob.put") return std::nullopt;
  const Json* bytes = nullptr;
  if (request.params.is_object() && request.params.contains("bytes")) bytes = &request.params.at("bytes");
  if (bytes == nullptr || !bytes->is_number_unsigned() || bytes->get<std::uint64_t>() > max_chunk_bytes) {
    throw ProtocolError("bad_request",
                        "blob.put needs \"bytes\", an integer from 0 to " + std::to_string(max_chunk_bytes) +
                            "; without it the end of the chunk is unknown and the connection is closed",
                        "/params/bytes");
  }
  return bytes->get<std::size_t>();
}

std::string request_line(const Json& id, const std::string& method, const Json& params) {
  return write_json({{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", params}});
}

std::string reply_line(const Json& id, const Json& result) {
  return write_json({{"jsonrpc", "2.0"}, {"id", id}, {"result", result}});
}

std::string error_line(const Json& id, const Json& error) {
  return write_json({{"jsonrpc", "2.0"}, {"id", id}, {"error", error}});
}

std::string fitted_error_line(const Json& id, Json error, std::size_t max_line) {
  std::string line = error_line(id, error);
  while (line.size() > max_line) {
    const std::string sentence = error["message"];
    if (sentence.empty()) break;
    error["message"] = sentence.substr(0, sentence.size() - std::min(sentence.size(), line.size() - max_line));
    line = error_line(id, error);
  }
  if (line.size() > max_line) error["data"].erase("pointer");
  return error_line(id, error);
}

std::string event_line(const Json& params) {
  return write_json({{"jsonrpc", "2.0"}, {"method", "event"}, {"params", params}});
}

}  // namespace sculpt::proto
