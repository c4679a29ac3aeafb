#include "server/base/settings.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>
#include <iterator>
#include <regex>

#include "server/base/settled_config.hpp"
#include "tests/server/temp_folder.hpp"

namespace sculpt::server {
namespace {

/// An environment variable for the length of a test.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) { ::setenv(name, value, 1); }
  ~Variable() { ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};

std::filesystem::path write_file(const TempFolder& folder, const std::string& text) {
  const std::filesystem::path file = folder.path() / "server.json";
  std::ofstream(file) << text;
  return file;
}

std::string file_text(const std::string& path) {
  std::ifstream in(std::string(SOURCE_DIR) + "/" + path);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::string refusal(const ConfigSources& sources) {
  try {
    settle_config(sources);
    return "accepted";
  } catch (const ConfigError& error) {
    return error.what();
  }
}

const Setting& setting(const std::string& name) {
  for (const Setting& known : settings())
    if (known.name == name) return known;
  throw std::logic_error(name);
}

TEST(Settings, LaterSourcesWinAndAreNamed) {
  const TempFolder folder;
  const auto file = write_file(folder, R"({"workers":1,"stall_s":2,"reply_limit_bytes":3,"data":"here"})");
  const Variable stall("SCULPTD_STALL_S", "4.5"), reply("SCULPTD_REPLY_LIMIT_BYTES", "5"), log("SCULPTD_LOG", "");
  const SettledConfig settled = settle_config({file, {{"reply_limit_bytes", "6"}}});
  EXPECT_EQ(settled.config.workers, 1);
  EXPECT_EQ(settled.config.stall, std::chrono::milliseconds(4500));
  EXPECT_EQ(settled.config.reply_limit_bytes, 6u);
  EXPECT_EQ(settled.config.data, folder.path() / "here");
  EXPECT_EQ(settled.origins.at("log"), "default");
  EXPECT_EQ(settled.origins.at("workers"), "file");
  EXPECT_EQ(settled.origins.at("stall_s"), "environment");
  EXPECT_EQ(settled.origins.at("reply_limit_bytes"), "flag");
}

TEST(Settings, AWrongVariableOrFlagIsNamed) {
  EXPECT_NE(refusal({{}, {{"workers", "1025"}}}).find("/workers must be an integer from 0 to 1024"), std::string::npos);
  const Variable workers("SCULPTD_WORKERS", "two");
  EXPECT_NE(refusal({}).find("SCULPTD_WORKERS: workers must be a number (0 to 1024), not 'two'"), std::string::npos);
}

TEST(Settings, EachShowsWhatItReads) {
  const Config preset = default_config();
  for (const Setting& known : settings()) {
    const Json shown = known.show(preset);
    if (shown == "") continue;  // no cells are found here
    Config read;
    read_setting(known, shown.is_string() ? shown.get<std::string>() : proto::write_json(shown), read);
    EXPECT_EQ(known.show(read), shown) << known.name;
  }
}

TEST(Settings, WhatNeedsAStartIsTold) {
  Config running, wanted;
  wanted.stall *= 2;
  EXPECT_TRUE(changes_that_need_a_start(running, wanted).empty());
  wanted.workers = 3;
  wanted.data = "elsewhere";
  EXPECT_EQ(changes_that_need_a_start(running, wanted), (std::vector<std::string>{"data", "workers"}));
}

TEST(Settings, TableAndJsonSayTheSame) {
  const SettledConfig settled = settle_config({{}, {{"listen", "[::1]:80"}}});
  const std::string table = settings_table(settled);
  const Json listed = settings_json(settled).at("settings");
  ASSERT_EQ(listed.size(), settings().size());
  EXPECT_EQ(listed[0].at("value"), "[::1]:80");
  EXPECT_EQ(listed[0].at("from"), "flag");
  EXPECT_EQ(listed[0].at("variable"), "SCULPTD_LISTEN");
  EXPECT_TRUE(std::regex_search(table, std::regex("\nlisten +\\[::1\\]:80 +flag"))) << table;
  for (const Json& row : listed) EXPECT_NE(table.find(row.at("name")), std::string::npos);
}

TEST(Settings, NamesBecomeFlagsAndVariables) {
  EXPECT_EQ(flag_of(setting("blob_limit_bytes")), "--blob-limit-bytes");
  EXPECT_EQ(variable_of(setting("blob_limit_bytes")), "SCULPTD_BLOB_LIMIT_BYTES");
}

// A row of the table in docs/server.md.
std::string documented(const Setting& known) {
  const Json preset = known.show(Config{});
  const std::string text = preset.is_string() ? preset.get<std::string>() : proto::write_json(preset);
  return "| `" + known.name + "` | " + known.type + " | " + (text.empty() ? "see below" : "`" + text + "`") + " | " +
         (known.change == Change::at_reload ? "reload" : "start") + " | " + known.help + " |\n";
}

TEST(Settings, AreDocumented) {
  const std::string docs = file_text("docs/server.md");
  for (const Setting& known : settings())
    EXPECT_NE(docs.find(documented(known)), std::string::npos) << "docs/server.md lacks\n" << documented(known);
}

TEST(Settings, TheShippedFileSaysAllThatHaveADefault) {
  const Json shipped = proto::parse_json(file_text("config/server.json"));
  for (const Setting& known : settings()) {
    const Json preset = known.show(Config{});
    if (preset == "") continue;
    EXPECT_EQ(shipped.value(known.name, Json()), preset) << known.name;
  }
}

}  // namespace
}  // namespace sculpt::server
