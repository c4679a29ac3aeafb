// Random text that nobody can guess.
#pragma once

#include <string>

namespace sculpt::server {

/// Two hex digits a byte. Throws std::runtime_error where the system has none.
std::string random_hex(int bytes);

}  // namespace sculpt::server
