// CRC-32 as zlib computes it (reflected polynomial edb88320): the checksum of chunks, because Python has it at hand.
#pragma once

#include <string>
#include <string_view>

namespace sculpt::proto {

/// 8 lower-case hex digits.
std::string crc32_hex(std::string_view bytes);

}  // namespace sculpt::proto
