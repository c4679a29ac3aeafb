// Bytes into a buffer.
#pragma once

#include <cstring>
#include <string_view>

namespace sculpt {

/// Returns where the text ends; `out` has room for it.
inline char* write_text(char* out, std::string_view text) {
  std::memcpy(out, text.data(), text.size());
  return out + text.size();
}

}  // namespace sculpt
