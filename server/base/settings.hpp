// Everything that can be set, in one table: from it come the reading of config file, environment and flags, what
// `sculptd config` and --help print, and what a reload may change (settled_config.hpp).
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "proto/fields.hpp"
#include "server/base/config.hpp"

namespace sculpt::server {

/// When another value takes effect.
enum class Change { at_start, at_reload };

/// The place of one setting in a JSON object; relative paths are relative to the folder.
struct SettingEntry {
  proto::Fields& fields;
  const std::string& name;
  const std::filesystem::path& folder;
};

struct Setting {
  std::string name;  ///< in the file; see also flag_of and variable_of
  std::string type;  ///< for people, with unit and range
  Change change;
  std::string help;                                 ///< one line
  bool is_text;                                     ///< a string in JSON; flag and variable then give it without quotes
  std::function<void(SettingEntry, Config&)> read;  ///< throws ProtocolError or ConfigError
  std::function<Json(const Config&)> show;
};

/// In the order in which they are shown.
const std::vector<Setting>& settings();
/// Null: there is none of that name.
const Setting* find_setting(const std::string& name);
/// "--blob-limit-bytes"
std::string flag_of(const Setting& setting);
/// "SCULPTD_BLOB_LIMIT_BYTES"
std::string variable_of(const Setting& setting);

/// Every setting of the object; relative paths are relative to `folder`. Throws ProtocolError or ConfigError for what
/// cannot be used, and ConfigError with the nearest known name for what is not known.
void read_settings(const Json& object, const std::filesystem::path& folder, Config& config);
/// One setting, as a flag or a variable gives it. Throws ConfigError.
void read_setting(const Setting& setting, const std::string& text, Config& config);

}  // namespace sculpt::server
