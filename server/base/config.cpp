#include "server/base/config.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <string_view>

#include "core/cell/shipped_cells.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

fs::path home_data_folder() {
  if (const char* data = std::getenv("XDG_DATA_HOME"); data != nullptr && *data != '\0')
    return fs::path(data) / "sculptd";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return fs::path(home) / ".local/share/sculptd";
  return "sculptd-data";
}

}  // namespace

Config default_config() {
  Config config;
  config.data = home_data_folder();
  config.cells = shipped_cell_folders();
  return config;
}

std::string without_password(const std::string& url) {
  const std::size_t start = url.find("://"), end = url.find('@');
  std::string shown = url;
  if (start != std::string::npos && end != std::string::npos) {
    const std::size_t colon = url.find(':', start + 3);
    if (colon < end) shown = url.substr(0, colon + 1) + "***" + url.substr(end);
  }
  for (std::size_t at = 0; (at = shown.find("password=", at)) != std::string::npos;) {
    at += std::string_view("password=").size();
    shown.replace(at, std::min(shown.find_first_of("& ", at), shown.size()) - at, "***");
  }
  return shown;
}

void set_listen(const std::string& address, Config& config) {
  const std::size_t colon = address.rfind(':');
  const std::string port = colon == std::string::npos ? "" : address.substr(colon + 1);
  const bool digits = !port.empty() && port.size() <= 5 && port.find_first_not_of("0123456789") == std::string::npos;
  if (!digits || std::stoi(port) > std::numeric_limits<std::uint16_t>::max() || colon == 0) {
    throw ConfigError("the listen address '" + address + "' must be HOST:PORT, for example 127.0.0.1:7878");
  }
  config.host = address.substr(0, colon);
  if (config.host.size() > 2 && config.host.front() == '[' && config.host.back() == ']') {
    config.host = config.host.substr(1, config.host.size() - 2);
  }
  config.port = static_cast<std::uint16_t>(std::stoi(port));
}

}  // namespace sculpt::server
