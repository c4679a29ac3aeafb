// What a client sends, from bytes to the params of every method. The first byte says in which pieces it comes.
#include <algorithm>
#include <array>

#include "proto/framing.hpp"
#include "proto/json.hpp"
#include "proto/messages.hpp"
#include "proto/request.hpp"
#include "tests/fuzz/target.hpp"

namespace {

using namespace sculpt;

constexpr std::size_t line_limit = 4096;  // reached by inputs of a fuzzer's size

// Any method's params may come with any other's name.
void read_params(const Json& params) {
  const std::array<void (*)(const Json&), 13> readers{
      [](const Json& json) { read_hello(json); },      [](const Json& json) { read_blob_put(json); },
      [](const Json& json) { read_blob_name(json); },  [](const Json& json) { to_json(read_submit(json).spec); },
      [](const Json& json) { read_job_id(json); },     [](const Json& json) { read_list(json); },
      [](const Json& json) { read_wait(json); },       [](const Json& json) { read_subscribe(json); },
      [](const Json& json) { read_nothing(json); },    [](const Json& json) { read_artifact_read(json); },
      [](const Json& json) { read_pin(json); },        [](const Json& json) { read_schema_method(json); },
      [](const Json& json) { read_unsubscribe(json); }};
  for (const auto& read : readers) {
    try {
      read(params);
    } catch (const ProtocolError& error) {
      write_json(error_object(error.code(), error.what(), error.pointer()));
    }
  }
}

// False if the connection would be closed.
bool take_line(const std::string& line, FrameReader& reader) {
  if (!is_text(line)) return false;
  const ParsedLine parsed = parse_request(line);
  if (parsed.error) {
    error_line(parsed.request.id, error_object(parsed.error->code(), parsed.error->what(), parsed.error->pointer()));
    return true;
  }
  read_params(parsed.request.params);
  try {
    if (const auto bytes = announced_chunk(parsed.request)) reader.expect_chunk(*bytes);
  } catch (const ProtocolError&) {
    return false;
  }
  return true;
}

bool take_frames(FrameReader& reader) {
  while (const std::optional<WireFrame> frame = reader.next()) {
    if (frame->kind == WireFrame::Kind::too_long || frame->kind == WireFrame::Kind::bad_chunk) return false;
    if (frame->kind == WireFrame::Kind::line && !take_line(frame->bytes, reader)) return false;
  }
  return true;
}

}  // namespace

void read_hostile(std::string_view bytes) {
  if (bytes.empty()) return;
  const std::size_t piece = std::max<std::size_t>(1, static_cast<std::uint8_t>(bytes.front()));
  bytes.remove_prefix(1);
  FrameReader reader(line_limit);
  while (!bytes.empty()) {
    reader.feed(bytes.substr(0, piece));
    if (!take_frames(reader)) return;
    bytes.remove_prefix(std::min(piece, bytes.size()));
  }
}
