#include "server/base/time_stamp.hpp"

#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <stdexcept>

namespace sculpt::server {

std::uint64_t unix_ms() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
}

std::string utc_text(std::uint64_t unix_milliseconds) {
  const auto seconds = static_cast<std::time_t>(unix_milliseconds / 1000);
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  std::array<char, 32> date{};
  std::strftime(date.data(), date.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%s.%03dZ", date.data(), static_cast<int>(unix_milliseconds % 1000));
  return text.data();
}

std::uint64_t unix_ms_of(const std::string& utc_text) {
  std::tm parts{};
  const char* rest = strptime(utc_text.c_str(), "%Y-%m-%dT%H:%M:%S", &parts);
  if (rest == nullptr) throw std::invalid_argument("'" + utc_text + "' is no time stamp");
  return 1000 * static_cast<std::uint64_t>(timegm(&parts)) + std::stoul(rest + 1);
}

}  // namespace sculpt::server
