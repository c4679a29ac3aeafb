// The daemon as one object: data folder, store, workers and the socket.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "server/base/config.hpp"
#include "server/run/planner.hpp"

namespace sculpt::server {

class Server {
 public:
  /// Locks the data folder, puts interrupted jobs back into the queue and binds the address. Throws DataFolderError,
  /// StorageError, ListenError.
  Server(const Config& config, Planner planner);
  ~Server();

  const std::string& host() const;
  std::uint16_t port() const;
  /// Serves until `stop`; then running jobs are asked to end and go back to the queue. Ends the process if they do
  /// not within Config::drain.
  void run();
  /// From any thread.
  void stop();
  /// Makes SIGINT and SIGTERM call stop. A second one ends the process at once, as it would any.
  void stop_on_signals();
  /// Makes SIGHUP call `reread` on the I/O thread and take the config that it gives, all of it or nothing: when it
  /// throws ConfigError, or when a setting differs that takes effect only at a start, the log says so and all stays.
  void reload_on_hangup(std::function<Config()> reread);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sculpt::server
