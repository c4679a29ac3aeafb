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
  const std::array<void (*)(const Json&), 16> readers{[](const Json& json) { proto::read_hello(json); },
                                                      [](const Json& json) { proto::read_blob_put(json); },
                                                      [](const Json& json) { proto::read_blob_name(json); },
                                                      [](const Json& json) { to_json(proto::read_submit(json).spec); },
                                                      [](const Json& json) { proto::read_job_id(json); },
                                                      [](const Json& json) { proto::read_list(json); },
                                                      [](const Json& json) { proto::read_wait(json); },
                                                      [](const Json& json) { proto::read_subscribe(json); },
                                                      [](const Json& json) { proto::read_nothing(json); },
                                                      [](const Json& json) { proto::read_artifact_read(json); },
                                                      [](const Json& json) { proto::read_pin(json); },
                                                      [](const Json& json) { proto::read_artifact_link(json); },
                                                      [](const Json& json) { proto::read_samples(json); },
                                                      [](const Json& json) { proto::read_cell_read(json); },
                                                      [](const Json& json) { proto::read_schema(json); },
                                                      [](const Json& json) { proto::read_unsubscribe(json); }};
  for (const auto& read : readers) {
    try {
      read(params);
    } catch (const proto::ProtocolError& error) {
      proto::write_json(proto::error_object(error.code(), error.what(), error.pointer()));
    }
  }
}

// False if the connection would be closed.
bool take_line(const std::string& line, proto::FrameReader& reader) {
  if (!proto::is_text(line)) return false;
  const proto::ParsedLine parsed = proto::parse_request(line);
  if (parsed.error) {
    proto::error_line(parsed.request.id,
                      proto::error_object(parsed.error->code(), parsed.error->what(), parsed.error->pointer()));
    return true;
  }
  read_params(parsed.request.params);
  try {
    if (const auto bytes = proto::announced_chunk(parsed.request)) reader.expect_chunk(*bytes);
  } catch (const proto::ProtocolError&) {
    return false;
  }
  return true;
}

bool take_frames(proto::FrameReader& reader) {
  while (const std::optional<proto::WireFrame> frame = reader.next()) {
    if (frame->kind == proto::WireFrame::Kind::too_long || frame->kind == proto::WireFrame::Kind::bad_chunk)
      return false;
    if (frame->kind == proto::WireFrame::Kind::line && !take_line(frame->bytes, reader)) return false;
  }
  return true;
}

}  // namespace

void read_hostile(std::string_view bytes) {
  if (bytes.empty()) return;
  const std::size_t piece = std::max<std::size_t>(1, static_cast<std::uint8_t>(bytes.front()));
  bytes.remove_prefix(1);
  proto::FrameReader reader(line_limit);
  while (!bytes.empty()) {
    reader.feed(bytes.substr(0, piece));
    if (!take_frames(reader)) return;
    bytes.remove_prefix(std::min(piece, bytes.size()));
  }
}
