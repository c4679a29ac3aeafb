// Wall time for people: no decision hangs on it.
#pragma once

#include <cstdint>
#include <string>

namespace sculpt {

std::uint64_t unix_ms();
/// "2026-01-31T12:00:00.000Z"
std::string utc_text(std::uint64_t unix_milliseconds);

}  // namespace sculpt
