// Random text that nobody can guess.
#pragma once

#include <string>
#include <string_view>

namespace sculpt::server {

/// Two lower-case digits a byte.
std::string hex_of(std::string_view bytes);
/// So many random bytes, as hex digits. Throws std::runtime_error where the system has none.
std::string random_hex(int bytes);

}  // namespace sculpt::server
