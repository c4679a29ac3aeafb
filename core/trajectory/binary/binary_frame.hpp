// What surrounds the bodies of the segments in an .sct file. Internal to trajectory/.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "core/trajectory/binary/file_segment.hpp"
#include "core/trajectory/header.hpp"

namespace sculpt {

inline constexpr std::string_view binary_magic = "SCULPTRJ";
inline constexpr std::uint32_t binary_version = 2, mill_binary_version = 3;  ///< of format 1, of format 2
inline constexpr std::size_t sha256_hex_bytes = 64;

enum class BinaryTag : std::uint8_t { segment = 1, index = 2 };

/// Appends a whole number, little-endian on every machine.
template <typename Word>
void append_word(std::string& out, Word value) {
  for (std::size_t at = 0; at < sizeof(Word); ++at) out += static_cast<char>(value >> (8 * at) & 0xff);
}

template <typename Word>
Word word_at(std::string_view bytes, std::size_t offset) {
  Word value = 0;
  for (std::size_t at = 0; at < sizeof(Word); ++at)
    value |= static_cast<Word>(static_cast<Word>(static_cast<unsigned char>(bytes[offset + at])) << (8 * at));
  return value;
}

/// zlib's CRC-32.
std::uint32_t crc32_of(std::string_view bytes);

/// Bytes in, counted; every refusal names the byte.
class BinaryIn {
 public:
  explicit BinaryIn(std::istream& in, std::uint64_t offset = 0) : in_(in), offset_(offset) {}

  /// Throws where the file is cut short. Callers bound `size`: it is allocated at once.
  std::string bytes(std::size_t size);
  bool at_end();
  std::uint64_t offset() const { return offset_; }
  std::string where() const;
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  std::istream& in_;
  std::uint64_t offset_;
};

/// Everything before the first segment.
std::string preamble_bytes(const TrajectoryHeader& header);
/// Gives its bytes in `raw` too, for hashing.
TrajectoryHeader read_preamble(BinaryIn& in, std::string& raw);

/// The head of a segment (tag, counts, checksum) and its body.
struct SegmentBytes {
  std::size_t keyframes = 0;
  std::uint64_t first_removed = 0;
  std::string body;

  std::string head() const;
};
inline constexpr std::size_t segment_head_bytes = 1 + 4 + 8 + 4 + 4;
/// Reads from after the tag on; checks the sizes and the checksum.
SegmentBytes read_segment(BinaryIn& in, std::size_t columns);

/// Everything from the index's tag to its checksum; `offset` = where it begins in the file.
std::string index_bytes(const std::vector<FileSegment>& segments, std::uint64_t keyframes, std::uint64_t removed,
                        std::uint64_t offset);

}  // namespace sculpt
