#include "server/base/settled_config.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

std::string shown(const Json& value) {
  return value.is_string() ? value.get<std::string>() : proto::write_json(value);
}

}  // namespace

std::vector<std::string> read_config(const fs::path& file, Config& config) {
  std::ifstream in(file);
  if (!in) throw ConfigError("cannot read the config file '" + file.string() + "'");
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  try {
    const Json json = proto::parse_json(text);
    read_settings(json, fs::absolute(file).parent_path(), config);
    std::vector<std::string> names;
    for (const auto& [name, value] : json.items()) names.push_back(name);
    return names;
  } catch (const std::runtime_error& error) {
    throw ConfigError("the config file '" + file.string() + "': " + error.what());
  }
}

SettledConfig settle_config(const ConfigSources& sources) {
  SettledConfig settled{default_config(), {}};
  for (const Setting& setting : settings()) settled.origins[setting.name] = "default";
  if (!sources.file.empty()) {
    for (const std::string& name : read_config(sources.file, settled.config)) settled.origins[name] = "file";
  }
  for (const Setting& setting : settings()) {
    const char* text = std::getenv(variable_of(setting).c_str());
    if (text == nullptr || *text == '\0') continue;
    try {
      read_setting(setting, text, settled.config);
    } catch (const ConfigError& error) {
      throw ConfigError("the environment variable " + variable_of(setting) + ": " + error.what());
    }
    settled.origins[setting.name] = "environment";
  }
  for (const auto& [name, text] : sources.flags) {
    read_setting(*find_setting(name), text, settled.config);
    settled.origins[name] = "flag";
  }
  return settled;
}

std::vector<std::string> changes_that_need_a_start(const Config& running, const Config& wanted) {
  std::vector<std::string> names;
  for (const Setting& setting : settings()) {
    const bool differs = setting.show(running) != setting.show(wanted);
    if (differs && setting.change == Change::at_start) names.push_back(setting.name);
  }
  return names;
}

std::string settings_table(const SettledConfig& settled) {
  std::vector<std::array<std::string, 3>> rows{{"SETTING", "VALUE", "FROM"}};
  for (const Setting& setting : settings())
    rows.push_back({setting.name, shown(setting.show(settled.config)), settled.origins.at(setting.name)});
  std::array<std::size_t, 2> widths{};
  for (const auto& row : rows)
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], row[i].size() + 2);
  std::string table;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < widths.size(); ++i) table += row[i] + std::string(widths[i] - row[i].size(), ' ');
    table += row.back() + "\n";
  }
  return table;
}

Json settings_json(const SettledConfig& settled) {
  Json list = Json::array();
  for (const Setting& setting : settings()) {
    list.push_back({{"name", setting.name},
                    {"value", setting.show(settled.config)},
                    {"from", settled.origins.at(setting.name)},
                    {"type", setting.type},
                    {"flag", flag_of(setting)},
                    {"variable", variable_of(setting)},
                    {"reload", setting.change == Change::at_reload},
                    {"help", setting.help}});
  }
  return {{"settings", std::move(list)}};
}

}  // namespace sculpt::server
