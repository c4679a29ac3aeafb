// One connection: bytes -> requests -> dispatch, and replies and events -> bytes. Lives on the I/O thread only.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "proto/framing.hpp"
#include "proto/messages.hpp"
#include "proto/request.hpp"
#include "server/net.hpp"

namespace sculpt {

struct Services;

/// The result of a call, with the chunk that follows it if there is one.
struct Answer {
  Json result = Json::object();
  std::optional<std::string> chunk;
};

class Session : public std::enable_shared_from_this<Session> {
 public:
  using Clock = std::chrono::steady_clock;

  Session(net::ip::tcp::socket socket, std::uint64_t number, Services& services);
  void start();

  /// Every dispatched request is answered exactly once, by one of these two. A reply over the client's max_line becomes
  /// an error.
  void answer(const Json& id, const Answer& answer);
  void refuse(const Json& id, const Json& error_object);
  /// An event over the client's max_line loses its data.
  void send_event(const EventMessage& event);
  /// Nothing more is read from this connection until `answer` or `refuse` was called for the request at hand.
  void hold() { held_ = true; }
  /// Sends what is queued, then closes.
  void finish();
  void close(const char* reason);

  /// Closes a connection that takes no bytes although there are some, lingers after an error, or is gone without a
  /// word.
  void check_stalled(Clock::time_point now, Clock::duration patience);
  std::size_t queued_bytes() const { return queued_bytes_; }
  bool writable() const;

  std::uint64_t number() const { return number_; }
  bool greeted() const { return greeted_; }
  void greet(const HelloParams& hello);
  std::size_t max_line() const { return max_line_; }
  /// Jobs whose events this connection gets; kept by Streams.
  std::set<std::string>& subscriptions() { return subscriptions_; }

 private:
  void read();
  void on_read(const boost::system::error_code& error, std::size_t bytes);
  void pump_input();
  bool may_take_requests() const;
  void on_frame(WireFrame frame);
  void on_line(std::string line);
  void handle(ParsedLine parsed, std::string chunk);
  void fail_connection(const Json& id, const char* code, const std::string& sentence, const std::string& pointer = {});
  void answered();
  void send(std::string bytes);
  void write();
  void on_write(const boost::system::error_code& error, std::size_t bytes);
  void on_input_end();
  bool broken();
  void close_if_done();

  net::ip::tcp::socket socket_;
  std::uint64_t number_;
  Services& services_;
  FrameReader reader_;
  std::string buffer_;
  ParsedLine waiting_;  // the request whose chunk is being read
  std::deque<std::string> queue_;
  std::size_t queued_bytes_ = 0;
  std::size_t sent_ = 0;  // of the first in the queue
  std::size_t max_line_ = max_line_bytes;
  int pending_ = 0;  // dispatched and not yet answered
  std::set<std::string> subscriptions_;
  Clock::time_point last_step_ = Clock::now();  // of the peer: bytes that it took, or the moment there were some for it
  bool greeted_ = false;
  bool first_line_ = true;
  bool reading_ = false;
  bool held_ = false;
  bool finishing_ = false;  // no more requests; close when everything is sent
  bool lingering_ = false;  // everything is sent; what still comes is thrown away, so that the peer gets our last line
  bool input_ended_ = false;
  bool closed_ = false;
};

}  // namespace sculpt
