// Defaults, config file, environment and flags -> the config that holds, and where each setting came from.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "server/base/settings.hpp"

namespace sculpt::server {

/// Overwrites what the file (JSON, see config/server.json) sets, and gives the names of that; relative paths are
/// relative to the file. Throws ConfigError.
std::vector<std::string> read_config(const std::filesystem::path& file, Config& config);
/// Where each setting may come from besides its default; later ones win.
struct ConfigSources {
  std::filesystem::path file;                ///< empty: none
  std::map<std::string, std::string> flags;  ///< name of the setting -> text
};

struct SettledConfig {
  Config config;
  std::map<std::string, std::string> origins;  ///< name of the setting -> default, file, environment or flag
};

/// Defaults < file < environment < flags. An empty variable counts as none. Throws ConfigError.
SettledConfig settle_config(const ConfigSources& sources);

/// The settings that differ and take effect only at a start.
std::vector<std::string> changes_that_need_a_start(const Config& running, const Config& wanted);

/// The table of `sculptd config`, and the same as one JSON document.
std::string settings_table(const SettledConfig& settled);
Json settings_json(const SettledConfig& settled);

}  // namespace sculpt::server
