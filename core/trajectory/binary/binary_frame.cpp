#include "core/trajectory/binary/binary_frame.hpp"

#include <zlib.h>

#include <istream>

#include "core/base/error.hpp"
#include "core/trajectory/binary/segment.hpp"
#include "core/trajectory/text/trajectory_line.hpp"

namespace sculpt {
namespace {

constexpr std::uint32_t max_header_bytes = 1 << 20;

}  // namespace

std::uint32_t crc32_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::string BinaryIn::bytes(std::size_t size) {
  std::string text(size, '\0');
  in_.read(text.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::size_t>(in_.gcount()) != size) refuse("the file is cut short");
  offset_ += size;
  return text;
}

bool BinaryIn::at_end() {
  return in_.peek() == std::istream::traits_type::eof();
}

std::string BinaryIn::where() const {
  return "binary trajectory byte " + std::to_string(offset_);
}

void BinaryIn::refuse(const std::string& what) const {
  throw InputError("trajectory_invalid", where() + ": " + what + "; fetch or plan the trajectory again");
}

std::string preamble_bytes(const TrajectoryHeader& header) {
  const std::string line = header_line(header);
  std::string text(binary_magic);
  append_word(text, header.mill ? mill_binary_version : binary_version);
  append_word(text, static_cast<std::uint32_t>(line.size()));
  text += line;
  append_word(text, crc32_of(text));
  return text;
}

TrajectoryHeader read_preamble(BinaryIn& in, std::string& raw) {
  raw = in.bytes(binary_magic.size());
  if (raw != binary_magic) in.refuse("not an .sct file");
  raw += in.bytes(8);
  const auto version = word_at<std::uint32_t>(raw, 8);
  if (version != binary_version && version != mill_binary_version)
    in.refuse("version " + std::to_string(version) + " is not known, only " + std::to_string(binary_version) + " and " +
              std::to_string(mill_binary_version));
  const auto size = word_at<std::uint32_t>(raw, 12);
  if (size > max_header_bytes) in.refuse("the header is longer than " + std::to_string(max_header_bytes) + " bytes");
  const std::string where = in.where(), line = in.bytes(size);
  raw += line;
  const std::string crc = in.bytes(4);
  if (word_at<std::uint32_t>(crc, 0) != crc32_of(raw)) in.refuse("the header's checksum is wrong");
  raw += crc;
  TrajectoryHeader header = parse_header_line(line, where);
  if (header.mill.has_value() != (version == mill_binary_version))
    in.refuse("version " + std::to_string(version) + " does not go with the format of the header");
  return header;
}

std::string SegmentBytes::head() const {
  std::string text(1, static_cast<char>(BinaryTag::segment));
  append_word(text, static_cast<std::uint32_t>(keyframes));
  append_word(text, first_removed);
  append_word(text, static_cast<std::uint32_t>(body.size()));
  const auto bytes_of = [](const std::string& bytes) { return reinterpret_cast<const Bytef*>(bytes.data()); };
  const uLong crc = crc32_z(crc32_z(0, bytes_of(text), text.size()), bytes_of(body), body.size());
  append_word(text, static_cast<std::uint32_t>(crc));
  return text;
}

SegmentBytes read_segment(BinaryIn& in, std::size_t columns) {
  const std::string head = in.bytes(segment_head_bytes - 1);
  SegmentBytes segment{word_at<std::uint32_t>(head, 0), word_at<std::uint64_t>(head, 4), {}};
  if (segment.keyframes < 1 || segment.keyframes > max_segment_keyframes)
    in.refuse("a segment of " + std::to_string(segment.keyframes) + " keyframes, not 1 to " +
              std::to_string(max_segment_keyframes));
  const auto size = word_at<std::uint32_t>(head, 12);
  if (size > max_segment_bytes(segment.keyframes, columns))
    in.refuse("a segment of " + std::to_string(segment.keyframes) + " keyframes cannot take " + std::to_string(size) +
              " bytes");
  segment.body = in.bytes(size);
  if (segment.head().substr(1) != head) in.refuse("the segment's checksum is wrong");
  return segment;
}

std::string index_bytes(const std::vector<FileSegment>& segments, std::uint64_t keyframes, std::uint64_t removed,
                        std::uint64_t offset) {
  std::string text(1, static_cast<char>(BinaryTag::index));
  append_word(text, static_cast<std::uint32_t>(segments.size()));
  for (const FileSegment& segment : segments)
    for (std::uint64_t value : {segment.offset, segment.first_keyframe, segment.first_removed})
      append_word(text, value);
  for (std::uint64_t value : {keyframes, removed, offset}) append_word(text, value);
  append_word(text, crc32_of(text));
  return text;
}

}  // namespace sculpt
