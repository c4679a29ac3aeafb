// The daemon as one object: data folder, store, workers and the socket.
#pragma once

#include <cstdint>
#include <memory>

#include "server/config.hpp"
#include "server/planner.hpp"

namespace sculpt {

class Server {
 public:
  /// Locks the data folder, puts interrupted jobs back into the queue and binds the address. Throws DataFolderError,
  /// StorageError, ListenError.
  Server(const Config& config, Planner planner);
  ~Server();

  const std::string& host() const;
  std::uint16_t port() const;
  /// Serves until `stop`; then running jobs are asked to end and go back to the queue.
  void run();
  /// From any thread.
  void stop();
  /// Makes SIGINT and SIGTERM call stop.
  void stop_on_signals();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sculpt
