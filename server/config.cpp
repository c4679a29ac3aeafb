#include "server/config.hpp"

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

fs::path home_data_folder() {
  if (const char* data = std::getenv("XDG_DATA_HOME"); data != nullptr && *data != '\0')
    return fs::path(data) / "sculptd";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return fs::path(home) / ".local/share/sculptd";
  return "sculptd-data";
}

void apply(Fields fields, const fs::path& folder, Config& config) {
  if (fields.has("listen")) set_listen(fields.text("listen"), config);
  if (fields.has("data")) config.data = folder / fields.text("data");
  if (fields.has("workers")) config.workers = static_cast<int>(fields.integer("workers", 0, max_workers));
  if (fields.has("log")) config.log = fields.text("log");
  if (fields.has("cells")) config.cells = {folder / fields.text("cells")};
  if (fields.has("blob_limit_bytes")) config.blob_limit_bytes = fields.count("blob_limit_bytes", max_limit);
  if (fields.has("memory_cap_bytes")) config.memory_cap_bytes = fields.count("memory_cap_bytes", max_limit);
  if (fields.has("memory_bytes")) config.memory_bytes = fields.count("memory_bytes", max_limit);
  if (fields.has("isolate")) config.isolate = fields.flag("isolate");
  if (fields.has("retry_backoff_s")) {
    config.retry_backoff =
        std::chrono::milliseconds(static_cast<std::int64_t>(1000 * fields.number("retry_backoff_s", 0.001, 86400)));
  }
  if (fields.has("reply_limit_bytes")) config.reply_limit_bytes = fields.count("reply_limit_bytes", max_limit);
  if (fields.has("stall_s")) {
    config.stall = std::chrono::milliseconds(static_cast<std::int64_t>(1000 * fields.number("stall_s", 0.001, 86400)));
  }
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
