// What can be set. The table of settings (settings.hpp) says how: defaults < config file < environment < flags.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace sculpt::server {

/// The config cannot be used; what() names the file and the field.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Config {
  std::string host = "127.0.0.1";
  std::uint16_t port = 7878;  ///< 0: any free one
  std::filesystem::path data;
  std::string store;                           ///< "postgresql://...", shared with other daemons; empty: in `data`
  std::filesystem::path store_password_file;   ///< empty: none
  std::filesystem::path shared;                ///< with such a store: blobs and results, for all its daemons
  std::chrono::milliseconds lease{30000};      ///< of a job; a daemon that is silent for so long has lost it
  std::vector<std::string> queues{"default"};  ///< whose jobs are planned here
  int workers = 0;                             ///< 0: one less than there are cores, at least 1
  std::vector<std::filesystem::path> cells;    ///< folders with cell files
  std::string log = "info";                    ///< trace debug info warn error off
  std::string log_format = "text";             ///< text json
  std::uint64_t blob_limit_bytes = 2ull << 30;
  std::uint64_t memory_cap_bytes = 2ull << 30;  ///< per job
  std::uint64_t memory_bytes = 0;               ///< of all jobs that run at once; 0: three quarters of the machine's
  std::chrono::milliseconds keep{7 * 24 * 3600 * 1000ll};  ///< a finished job and its results, unless pinned
  std::uint64_t keep_bytes = 20ull << 30;                  ///< of all finished jobs; the oldest go first
  int max_jobs = 100'000;                                  ///< that have not ended
  int max_jobs_per_owner = 10'000;
  bool isolate = true;                              ///< run every job in a process of its own, not only suspects
  std::chrono::milliseconds retry_backoff{10000};   ///< before the second try of a job that failed for a passing reason
  std::filesystem::path worker = "/proc/self/exe";  ///< the program that runs a job with --run-job; not a setting
  std::uint64_t reply_limit_bytes = 32u << 20;    ///< unsent bytes of one connection; above it the connection is closed
  std::chrono::milliseconds check_time{120000};   ///< for reading files that nobody has read yet
  std::chrono::milliseconds result_time{600000};  ///< for what is made of a finished job, as a program
  std::chrono::milliseconds stall{
      30000};  ///< a connection that takes no bytes for so long while there are some is closed
  std::chrono::milliseconds drain{10000};       ///< for running jobs to end in order when the daemon stops
  std::chrono::milliseconds hello_time{10000};  ///< for the TLS handshake, an HTTP request's head, hello
  int max_connections = 1000;                   ///< fewer where the process may not open so many files
  int max_connections_per_owner = 500;
  std::uint64_t disk_floor_bytes = 64u << 20;                     ///< below it /readyz says no
  std::filesystem::path unix_socket;                              ///< empty: none
  std::filesystem::path tokens;                                   ///< empty: none
  std::filesystem::path tls_certificate, tls_key, tls_client_ca;  ///< PEM; empty: none
  std::filesystem::path web;            ///< folder of the page instead of the one in the program; empty: none
  std::vector<std::string> host_names;  ///< by which HTTP may call this server, besides addresses and localhost
  std::vector<std::string> origins;     ///< of other web pages that may call it, "https://HOST[:PORT]"
};

/// With the data folder of the user ($XDG_DATA_HOME/sculptd or ~/.local/share/sculptd) and the cells found near the
/// program or the working folder.
Config default_config();
/// The address of a database for logs and for people: with *** in the place of a password.
std::string without_password(const std::string& url);
/// "HOST:PORT" or "[V6]:PORT". Throws ConfigError.
void set_listen(const std::string& address, Config& config);

}  // namespace sculpt::server
