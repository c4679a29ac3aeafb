// What every open connection has, whatever it speaks, and the list of all of them. I/O thread only.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <string>

#include "server/access/peer.hpp"

namespace sculpt::server {

/// What a peer that came when the server was full is told.
inline constexpr const char* full_sentence =
    "this server has as many connections as it may: try again later, or raise max_connections and the limit of open "
    "files";

class Connection {
 public:
  using Clock = std::chrono::steady_clock;

  virtual ~Connection() = default;
  virtual void close(const char* reason) = 0;
  /// Closes it when it missed a deadline. Call a few times a second.
  virtual void check_deadlines(Clock::time_point now) = 0;
  /// Nobody until it has said who it is.
  virtual const Identity* identity() const { return nullptr; }
  /// Has a place beyond the limit of connections.
  virtual bool spare() const = 0;
};

class Connections {
 public:
  void add(const std::shared_ptr<Connection>& connection) { list_.push_back(connection); }
  /// Without spare ones.
  std::size_t count();
  /// Those that have said that they are of this owner.
  std::size_t count_of(const std::string& owner);
  void for_each(const std::function<void(Connection&)>& visit);
  /// Closes the oldest spare ones until at most so many are left.
  void thin_spare(std::size_t most);

 private:
  std::list<std::weak_ptr<Connection>> list_;
};

}  // namespace sculpt::server
