#include "server/config.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>

#include "core/cell/shipped_cells.hpp"
#include "proto/fields.hpp"

namespace sculpt {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t max_limit = std::numeric_limits<std::int64_t>::max();
constexpr int max_workers = 1024;
constexpr int max_sockets = 1 << 20;

fs::path home_data_folder() {
  if (const char* data = std::getenv("XDG_DATA_HOME"); data != nullptr && *data != '\0')
    return fs::path(data) / "sculptd";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return fs::path(home) / ".local/share/sculptd";
  return "sculptd-data";
}

std::chrono::milliseconds seconds(Fields& fields, const char* field) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(1000 * fields.number(field, 0.001, 86400)));
}

std::vector<std::string> words(Fields& fields, const char* field) {
  const Json& list = fields.value(field);
  const auto is_word = [](const Json& word) { return word.is_string(); };
  if (!list.is_array() || !std::ranges::all_of(list, is_word)) fields.refuse(field, "must be an array of strings");
  return list.get<std::vector<std::string>>();
}

void apply_door(Fields& fields, const fs::path& folder, Config& config) {
  if (fields.has("hello_s")) config.hello_time = seconds(fields, "hello_s");
  if (fields.has("max_connections")) {
    config.max_connections = static_cast<int>(fields.integer("max_connections", 1, max_sockets));
  }
  if (fields.has("max_connections_per_owner")) {
    config.max_connections_per_owner = static_cast<int>(fields.integer("max_connections_per_owner", 1, max_sockets));
  }
  if (fields.has("disk_floor_bytes")) config.disk_floor_bytes = fields.count("disk_floor_bytes", max_limit);
  if (fields.has("unix")) config.unix_socket = folder / fields.text("unix");
  if (fields.has("tokens")) config.tokens = folder / fields.text("tokens");
  if (fields.has("tls_certificate")) config.tls_certificate = folder / fields.text("tls_certificate");
  if (fields.has("tls_key")) config.tls_key = folder / fields.text("tls_key");
  if (fields.has("tls_client_ca")) config.tls_client_ca = folder / fields.text("tls_client_ca");
  if (fields.has("host_names")) config.host_names = words(fields, "host_names");
  if (fields.has("origins")) config.origins = words(fields, "origins");
}

void apply(Fields fields, const fs::path& folder, Config& config) {
  if (fields.has("listen")) set_listen(fields.text("listen"), config);
  if (fields.has("data")) config.data = folder / fields.text("data");
  if (fields.has("workers")) config.workers = static_cast<int>(fields.integer("workers", 0, max_workers));
  if (fields.has("log")) config.log = fields.text("log");
  if (fields.has("cells")) config.cells = {folder / fields.text("cells")};
  if (fields.has("blob_limit_bytes")) config.blob_limit_bytes = fields.count("blob_limit_bytes", max_limit);
  if (fields.has("memory_cap_bytes")) config.memory_cap_bytes = fields.count("memory_cap_bytes", max_limit);
  if (fields.has("reply_limit_bytes")) config.reply_limit_bytes = fields.count("reply_limit_bytes", max_limit);
  if (fields.has("stall_s")) config.stall = seconds(fields, "stall_s");
  apply_door(fields, folder, config);
  fields.done();
}

}  // namespace

Config default_config() {
  Config config;
  config.data = home_data_folder();
  config.cells = shipped_cell_folders();
  return config;
}

void read_config(const fs::path& file, Config& config) {
  std::ifstream in(file);
  if (!in) throw ConfigError("cannot read the config file '" + file.string() + "'");
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  try {
    const Json json = parse_json(text);
    apply(Fields(json, ""), fs::absolute(file).parent_path(), config);
  } catch (const std::runtime_error& error) {
    throw ConfigError("the config file '" + file.string() + "': " + error.what());
  }
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

}  // namespace sculpt
