// Wall time for people: no decision hangs on it.
#pragma once

#include <cstdint>
#include <string>

namespace sculpt::server {

std::uint64_t unix_ms();
/// "2026-01-31T12:00:00.000Z"
std::string utc_text(std::uint64_t unix_milliseconds);
/// The other way, of what utc_text made.
std::uint64_t unix_ms_of(const std::string& utc_text);

}  // namespace sculpt::server
