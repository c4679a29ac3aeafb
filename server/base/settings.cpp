#include "server/base/settings.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <numeric>

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t max_bytes = std::numeric_limits<std::int64_t>::max();
constexpr int max_workers = 1024, max_sockets = 1 << 20, max_open_jobs = 100'000'000;
constexpr double min_s = 0.001, max_s = 86400, max_keep_s = 100.0 * 366 * 86400;

// --- the kinds of settings

Setting integer(const char* name, int Config::*field, int low, int high, Change change, const char* help) {
  return {name,
          std::to_string(low) + " to " + std::to_string(high),
          change,
          help,
          false,
          [=](SettingEntry entry, Config& config) {
            config.*field = static_cast<int>(entry.fields.integer(entry.name, low, high));
          },
          [=](const Config& config) -> Json { return config.*field; }};
}

Setting bytes(const char* name, std::uint64_t Config::*field, Change change, const char* help) {
  return {name,
          "bytes",
          change,
          help,
          false,
          [=](SettingEntry entry, Config& config) { config.*field = entry.fields.count(entry.name, max_bytes); },
          [=](const Config& config) -> Json { return config.*field; }};
}

Setting flag(const char* name, bool Config::*field, Change change, const char* help) {
  return {name,
          "true, false",
          change,
          help,
          false,
          [=](SettingEntry entry, Config& config) { config.*field = entry.fields.flag(entry.name); },
          [=](const Config& config) -> Json { return config.*field; }};
}

Setting seconds(const char* name, std::chrono::milliseconds Config::*field, Change change, const char* help,
                double high = max_s) {
  return {name,
          "seconds",
          change,
          help,
          false,
          [=](SettingEntry entry, Config& config) {
            const double wanted = entry.fields.number(entry.name, min_s, high);
            config.*field = std::chrono::milliseconds(static_cast<std::int64_t>(1000 * wanted));
          },
          [=](const Config& config) -> Json {
            const std::int64_t ms = (config.*field).count();
            return ms % 1000 == 0 ? Json(ms / 1000) : Json(static_cast<double>(ms) / 1000);
          }};
}

Setting path(const char* name, fs::path Config::*field, Change change, const char* help) {
  return {
      name,
      "path",
      change,
      help,
      true,
      [=](SettingEntry entry, Config& config) { config.*field = entry.folder / entry.fields.text(entry.name, 4096); },
      [=](const Config& config) -> Json { return (config.*field).string(); }};
}

std::string joined(const std::vector<std::string>& words, const char* between) {
  return std::accumulate(words.begin() + 1, words.end(), words.front(),
                         [=](const std::string& left, const std::string& right) { return left + between + right; });
}

Setting list(const char* name, std::vector<std::string> Config::*field, Change change, const char* help) {
  return {name,
          "JSON array of strings",
          change,
          help,
          false,
          [=](SettingEntry entry, Config& config) {
            const Json& words = entry.fields.value(entry.name);
            const auto is_word = [](const Json& word) { return word.is_string(); };
            if (!words.is_array() || !std::ranges::all_of(words, is_word))
              entry.fields.refuse(entry.name, "must be an array of strings");
            config.*field = words.get<std::vector<std::string>>();
          },
          [=](const Config& config) -> Json { return config.*field; }};
}

Setting choice(const char* name, std::string Config::*field, const std::vector<std::string>& words, Change change,
               const char* help) {
  return {name,
          joined(words, ", "),
          change,
          help,
          true,
          [=](SettingEntry entry, Config& config) {
            const std::string word = entry.fields.text(entry.name);
            if (std::ranges::find(words, word) == words.end())
              entry.fields.refuse(entry.name, "must be one of " + joined(words, ", ") + ", not " + word);
            config.*field = word;
          },
          [=](const Config& config) -> Json { return config.*field; }};
}

Setting listen_address(const char* name, Change change, const char* help) {
  return {name,
          "HOST:PORT",
          change,
          help,
          true,
          [](SettingEntry entry, Config& config) { set_listen(entry.fields.text(entry.name), config); },
          [](const Config& config) -> Json {
            const bool v6 = config.host.find(':') != std::string::npos;
            return (v6 ? "[" + config.host + "]" : config.host) + ":" + std::to_string(config.port);
          }};
}

Setting database(const char* name, std::string Config::*field, Change change, const char* help) {
  return {name,
          "postgresql://...",
          change,
          help,
          true,
          [=](SettingEntry entry, Config& config) { config.*field = entry.fields.text(entry.name, 4096); },
          [=](const Config& config) -> Json { return without_password(config.*field); }};
}

Setting cell_folder(const char* name, Change change, const char* help) {
  return {
      name,
      "path",
      change,
      help,
      true,
      [](SettingEntry entry, Config& config) { config.cells = {entry.folder / entry.fields.text(entry.name, 4096)}; },
      [](const Config& config) -> Json { return config.cells.empty() ? "" : config.cells.front().string(); }};
}

// --- names

std::size_t edits_between(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, changed}));
    }
  }
  return row.back();
}

const std::string& nearest_name(const std::string& wrong) {
  const auto edits = [&](const Setting& setting) { return edits_between(wrong, setting.name); };
  return std::ranges::min_element(settings(), {}, edits)->name;
}

}  // namespace

const std::vector<Setting>& settings() {
  using enum Change;
  static const std::vector<Setting> table{
      listen_address("listen", at_start, "where to listen; port 0 takes any free one"),
      path("data", &Config::data, at_start, "folder for jobs and results"),
      database("store", &Config::store, at_start,
               "database of the jobs, shared with other daemons; without it they are in the data folder"),
      path("store_password_file", &Config::store_password_file, at_start,
           "file whose first line is the password of that database; none by default"),
      path("shared", &Config::shared, at_start,
           "with such a database: folder for uploads and results that all its daemons reach; without it they are in "
           "the database"),
      seconds("lease_s", &Config::lease, at_start,
              "with such a database: a daemon that is silent for so long has lost its jobs to the others"),
      integer("workers", &Config::workers, 0, max_workers, at_start,
              "jobs that run at once; 0: one less than there are cores"),
      list("queues", &Config::queues, at_start, "whose jobs are planned here; a job names one, or is in default"),
      cell_folder("cells", at_start, "folder with cell files"),
      choice("log", &Config::log, {"trace", "debug", "info", "warn", "error", "off"}, at_reload,
             "what is logged: this and what is worse"),
      choice("log_format", &Config::log_format, {"text", "json"}, at_reload, "for people or for programs"),
      bytes("blob_limit_bytes", &Config::blob_limit_bytes, at_start, "largest upload"),
      bytes("memory_cap_bytes", &Config::memory_cap_bytes, at_start,
            "predicted memory of one job; above it the job is refused"),
      bytes("memory_bytes", &Config::memory_bytes, at_start,
            "predicted memory of the jobs that run at once; 0: three quarters of the machine's"),
      seconds("keep_s", &Config::keep, at_reload, "a finished job and its results are kept so long, unless pinned",
              max_keep_s),
      bytes("keep_bytes", &Config::keep_bytes, at_reload,
            "results of all finished jobs; above it the oldest jobs go, unless pinned"),
      integer("max_jobs", &Config::max_jobs, 1, max_open_jobs, at_start,
              "that have not ended; above it new ones are refused"),
      integer("max_jobs_per_owner", &Config::max_jobs_per_owner, 1, max_open_jobs, at_start,
              "that have not ended, of one token, certificate or user"),
      flag("isolate", &Config::isolate, at_start,
           "every job runs in a confined process of its own; false: in the daemon, unless it is suspected"),
      seconds("retry_backoff_s", &Config::retry_backoff, at_start,
              "before the second try of a job that failed for a reason that may pass; doubled for the third"),
      bytes("reply_limit_bytes", &Config::reply_limit_bytes, at_reload,
            "unsent bytes of one connection; above it the connection is closed"),
      seconds("check_s", &Config::check_time, at_reload, "a submitted mesh that is not read in so long is refused"),
      seconds("result_s", &Config::result_time, at_start,
              "a time law or a program of a finished job that is not found in so long is given up"),
      seconds("stall_s", &Config::stall, at_reload,
              "a connection that takes no bytes for so long while there are some is closed"),
      seconds("hello_s", &Config::hello_time, at_reload,
              "time for the TLS handshake, the head of an HTTP request, and hello"),
      integer("max_connections", &Config::max_connections, 1, max_sockets, at_reload,
              "open at once; never more than 32 fewer than the process may open files"),
      integer("max_connections_per_owner", &Config::max_connections_per_owner, 1, max_sockets, at_reload,
              "open at once with one token, certificate or user"),
      bytes("disk_floor_bytes", &Config::disk_floor_bytes, at_reload, "free space below which /readyz says no"),
      path("unix", &Config::unix_socket, at_start, "unix socket to listen on too; none by default"),
      path("tokens", &Config::tokens, at_start, "file of the tokens that clients must show; none by default"),
      path("tls_certificate", &Config::tls_certificate, at_start,
           "PEM file, the certificate with its chain; none by default"),
      path("tls_key", &Config::tls_key, at_start, "PEM file of its key; none by default"),
      path("tls_client_ca", &Config::tls_client_ca, at_start,
           "PEM file of the authority whose client certificates are taken; none by default"),
      path("web", &Config::web, at_reload,
           "folder to read the page's files from instead of those in the program; none by default"),
      list("host_names", &Config::host_names, at_reload, "names by which HTTP may call the server"),
      list("origins", &Config::origins, at_reload, "web pages that may call it, https://HOST[:PORT]"),
      seconds("drain_s", &Config::drain, at_reload,
              "a daemon that stops waits so long for running jobs to end in order"),
  };
  return table;
}

const Setting* find_setting(const std::string& name) {
  const auto found = std::ranges::find(settings(), name, &Setting::name);
  return found == settings().end() ? nullptr : &*found;
}

std::string flag_of(const Setting& setting) {
  std::string flag = "--" + setting.name;
  std::ranges::replace(flag, '_', '-');
  return flag;
}

std::string variable_of(const Setting& setting) {
  std::string variable = "SCULPTD_" + setting.name;
  std::ranges::transform(variable, variable.begin(), [](unsigned char c) { return std::toupper(c); });
  return variable;
}

void read_settings(const Json& object, const fs::path& folder, Config& config) {
  proto::Fields fields(object, "");
  for (const auto& [name, value] : object.items()) {
    const Setting* setting = find_setting(name);
    if (setting == nullptr) {
      throw ConfigError("/" + name + " is not known; the nearest setting is " + nearest_name(name) +
                        "; sculptd config shows all");
    }
    setting->read({fields, name, folder}, config);
  }
}

void read_setting(const Setting& setting, const std::string& text, Config& config) try {
  const Json object{{setting.name, setting.is_text ? Json(text) : proto::parse_json(text)}};
  read_settings(object, {}, config);
} catch (const proto::JsonError&) {
  throw ConfigError(setting.name + " must be a number (" + setting.type + "), not '" + text + "'");
} catch (const proto::ProtocolError& error) {
  throw ConfigError(error.what());
}

}  // namespace sculpt::server
