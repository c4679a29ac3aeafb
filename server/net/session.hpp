// One connection: bytes -> requests -> their handler, and replies and events -> bytes. Lives on the I/O thread only.
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
#include "server/net/connection_context.hpp"
#include "server/net/transport.hpp"

namespace sculpt::server {

struct WholeRead;

class Session : public Connection, public std::enable_shared_from_this<Session> {
 public:
  Session(std::unique_ptr<Transport> transport, Peer peer, ConnectionContext& context);
  /// `first`: what was read already.
  void start(std::string_view first);

  /// Every dispatched request is answered exactly once, by one of these two. A reply over the client's max_line becomes
  /// an error.
  void answer(const Json& id, Reply reply);
  void refuse(const Json& id, const Json& error_object);
  /// An event over the client's max_line loses its data; a state event without data says that there is more.
  void send_event(const proto::EventMessage& event);
  /// Call from the handler of a request: no other of this connection is taken until that one is answered.
  void hold() { held_by_ = taken_; }
  /// Sends what is queued, then closes.
  void finish();
  void close(const char* reason) override;
  /// Instead of start: says why, then closes.
  void turn_away(const char* code, const std::string& sentence);

  /// Closes a connection that takes no bytes although there are some, says no hello, lingers after an error, or is gone
  /// without a word.
  void check_deadlines(Clock::time_point now) override;
  std::size_t queued_bytes() const { return queued_bytes_; }
  bool writable() const;
  bool closed() const { return closed_; }
  /// Closes it when its peer asks nothing more and was told everything.
  void close_if_done();

  const Peer& peer() const { return peer_; }
  /// From hello on.
  const Identity* identity() const override { return identity_ ? &*identity_ : nullptr; }
  bool spare() const override { return peer_.spare && !closed_; }
  std::string owner() const { return identity_ ? identity_->owner : std::string(); }
  void greet(const proto::HelloParams& hello, Identity identity);
  std::size_t max_line() const { return max_line_; }
  /// Of the lines that it may send.
  std::size_t line_limit() const { return reader_.line_limit(); }
  /// Jobs whose events this connection gets, with "" for those of all jobs; kept by Streams.
  std::set<std::string>& subscriptions() { return subscriptions_; }
  /// Where this connection is in an artifact, for the one artifact.read that may be at work; null before the first.
  std::shared_ptr<WholeRead>& whole_read() { return whole_read_; }

 private:
  void read();
  void on_read(const boost::system::error_code& error, std::string_view bytes);
  void pump_input();
  bool may_take_requests() const;
  void on_frame(proto::WireFrame frame);
  void on_line(std::string line);
  void handle(proto::ParsedLine parsed, std::string chunk);
  void fail_connection(const Json& id, const char* code, const std::string& sentence, const std::string& pointer = {});
  void answered(const Json& id);
  /// One frame, its LF included.
  void send(std::string frame, Transport::Frame kind = Transport::Frame::line);
  void write();
  void on_write(const boost::system::error_code& error, std::size_t bytes);
  void on_input_end();
  bool broken();
  void probe_after(int seconds);

  struct Outgoing {
    std::string bytes;
    Transport::Frame kind;
  };

  std::unique_ptr<Transport> transport_;
  Peer peer_;
  ConnectionContext& context_;
  proto::FrameReader reader_;
  proto::ParsedLine waiting_;  // the request whose chunk is being read
  std::deque<Outgoing> queue_;
  std::size_t queued_bytes_ = 0;
  std::size_t sent_ = 0;  // of the first in the queue
  std::size_t max_line_ = proto::max_line_bytes;
  int pending_ = 0;  // dispatched and not yet answered
  Json taken_;       // id of the request that was dispatched last
  std::optional<Json> held_by_;
  std::set<std::string> subscriptions_;
  Clock::time_point last_step_ = Clock::now();  // of the peer: bytes that it took, or the moment there were some for it
  Clock::time_point opened_ = Clock::now();
  std::optional<Identity> identity_;
  bool first_line_ = true;
  bool reading_ = false;
  bool finishing_ = false;  // no more requests; close when everything is sent
  bool lingering_ = false;  // everything is sent; what still comes is thrown away, so that the peer gets our last line
  bool input_ended_ = false;
  bool closed_ = false;
  std::shared_ptr<WholeRead> whole_read_;
};

/// Answers at once.
void answer(const Call& call, const Json& result);

}  // namespace sculpt::server
