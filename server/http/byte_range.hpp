// HTTP's Range header -> which bytes (RFC 9110, section 14).
#pragma once

#include <cstdint>
#include <string_view>

namespace sculpt::server {

struct ByteRange {
  enum class Kind {
    whole,          ///< no usable range was asked for, or several: the answer is everything
    part,           ///< `bytes` > 0 from `offset` on
    unsatisfiable,  ///< nothing of it is there
  };
  Kind kind = Kind::whole;
  std::uint64_t offset = 0, bytes = 0;
};

/// The header's value, empty if there was none, for something of `size` bytes. Never throws.
ByteRange read_range(std::string_view header, std::uint64_t size);

}  // namespace sculpt::server
