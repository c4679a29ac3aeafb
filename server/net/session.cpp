#include "server/net/session.hpp"

#include <netinet/tcp.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>

#include "server/net/net.hpp"

namespace sculpt::server {
namespace {

constexpr std::size_t read_bytes = 64 << 10;
constexpr std::size_t hello_bytes = 4 << 10;        // of one read before hello: strangers get little memory
constexpr std::size_t short_line_bytes = 16 << 10;  // the longest line of who gives no work: its JSON is read at once
constexpr std::size_t low_water_bytes = 64 << 10;   // below it events are fetched for the peer
constexpr std::size_t high_water_bytes = 1 << 20;   // above it no more of its requests are taken
constexpr int max_pending = 64;
constexpr std::chrono::seconds linger_time{5};
constexpr int idle_probe_s = 60;
constexpr int ended_probe_s = 10;
constexpr int probe_interval_s = 10;
constexpr int lost_probes = 3;

}  // namespace

Session::Session(std::unique_ptr<Transport> transport, Peer peer, ConnectionContext& context)
    : transport_(std::move(transport)), peer_(std::move(peer)), context_(context), reader_(short_line_bytes) {}

void Session::start(std::string_view first) {
  spdlog::debug("conn={} session", peer_.number);
  probe_after(idle_probe_s);
  reader_.feed(first);
  pump_input();
}

void Session::turn_away(const char* code, const std::string& sentence) {
  fail_connection(nullptr, code, sentence);
}

void Session::greet(const proto::HelloParams& hello, Identity identity) {
  identity_ = std::move(identity);
  max_line_ = hello.max_line;
  reader_.set_line_limit(identity_->scope == Scope::read ? short_line_bytes : proto::max_line_bytes);
  // As JSON, so that no name can forge a line of the log.
  spdlog::log(identity_->owner.empty() ? spdlog::level::debug : spdlog::level::info, "conn={} owner={} client={}",
              peer_.number, identity_->owner, proto::write_json(hello.client));
}

bool Session::writable() const {
  return !closed_ && !finishing_ && queued_bytes_ < low_water_bytes;
}

// --- in

void Session::read() {
  if (reading_ || closed_ || input_ended_) return;
  reading_ = true;
  transport_->read(
      identity_ ? read_bytes : hello_bytes,
      [self = shared_from_this()](const auto& error, std::string_view bytes) { self->on_read(error, bytes); });
}

void Session::on_read(const boost::system::error_code& error, std::string_view bytes) {
  reading_ = false;
  if (closed_) return;
  if (error == net::error::eof) return on_input_end();
  if (error) return close("read failed");
  if (lingering_ || finishing_) return read();
  context_.counters.bytes_in += bytes.size();
  reader_.feed(bytes);
  pump_input();
}

// The peer may only have ended its side and wait for answers and events, or be gone: keepalive probes tell
// (check_deadlines).
void Session::on_input_end() {
  input_ended_ = true;
  if (lingering_) return close("lingered");
  probe_after(ended_probe_s);
  pump_input();
  close_if_done();
}

// A controller may stay silent for months; a peer that lost its power ends as a failed read. (A unix socket knows.)
void Session::probe_after(int seconds) {
  const int on = 1, handle = transport_->native_handle();
  ::setsockopt(handle, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
  ::setsockopt(handle, IPPROTO_TCP, TCP_KEEPIDLE, &seconds, sizeof seconds);
  ::setsockopt(handle, IPPROTO_TCP, TCP_KEEPINTVL, &probe_interval_s, sizeof probe_interval_s);
  ::setsockopt(handle, IPPROTO_TCP, TCP_KEEPCNT, &lost_probes, sizeof lost_probes);
}

bool Session::broken() {
  int error = 0;
  socklen_t size = sizeof error;
  return ::getsockopt(transport_->native_handle(), SOL_SOCKET, SO_ERROR, &error, &size) != 0 || error != 0;
}

bool Session::may_take_requests() const {
  return !closed_ && !finishing_ && !held_by_ && pending_ < max_pending && queued_bytes_ < high_water_bytes;
}

void Session::pump_input() {
  while (may_take_requests()) {
    std::optional<proto::WireFrame> frame = reader_.next();
    if (!frame) return read();
    on_frame(std::move(*frame));
  }
  if (finishing_) read();
}

void Session::on_frame(proto::WireFrame frame) {
  switch (frame.kind) {
    case proto::WireFrame::Kind::line:
      return on_line(std::move(frame.bytes));
    case proto::WireFrame::Kind::chunk:
      return handle(std::exchange(waiting_, {}), std::move(frame.bytes));
    case proto::WireFrame::Kind::too_long:
      return fail_connection(nullptr, "line_too_long",
                             "a line is over the limit of " + std::to_string(reader_.line_limit()) +
                                 (identity_ ? " bytes: send bulk with blob.put" : " bytes before hello") +
                                 "; the connection is closed");
    case proto::WireFrame::Kind::bad_chunk:
      return fail_connection(waiting_.request.id, "bad_request",
                             "the chunk is not followed by LF, so \"bytes\" was wrong; the connection is closed",
                             "/params/bytes");
  }
}

void Session::on_line(std::string line) {
  const bool first = std::exchange(first_line_, false);
  if (!proto::is_text(line) || (first && line.front() != '{')) {
    return fail_connection(nullptr, "not_text",
                           "this is no line of JSON (control bytes, not UTF-8, or another protocol); sculptd speaks "
                           "newline-delimited JSON-RPC, see PROTOCOL.md; the connection is closed");
  }
  proto::ParsedLine parsed = proto::parse_request(line);
  try {
    if (const std::optional<std::size_t> bytes = proto::announced_chunk(parsed.request)) {
      if (!identity_) {
        return fail_connection(parsed.request.id, "hello_required",
                               "say hello before you send bulk; the connection is closed");
      }
      waiting_ = std::move(parsed);
      reader_.expect_chunk(*bytes);
      return;
    }
  } catch (const proto::ProtocolError& error) {
    return fail_connection(parsed.request.id, error.code().c_str(), error.what(), error.pointer());
  }
  handle(std::move(parsed), {});
}

void Session::handle(proto::ParsedLine parsed, std::string chunk) {
  ++pending_;
  ++context_.counters.requests;
  if (parsed.error) {
    const proto::ProtocolError& error = *parsed.error;
    return refuse(parsed.request.id, proto::error_object(error.code(), error.what(), error.pointer()));
  }
  taken_ = parsed.request.id;
  context_.requests.take(
      {shared_from_this(), std::move(parsed.request.id), std::move(parsed.request.params), std::move(chunk)},
      parsed.request.method);
}

void Session::fail_connection(const Json& id, const char* code, const std::string& sentence,
                              const std::string& pointer) {
  spdlog::info("conn={} {}", peer_.number, code);
  send(proto::error_line(id, proto::error_object(code, sentence, pointer)) + "\n");
  finish();
}

// --- out

void Session::answer(const Json& id, Reply reply) {
  if (reply.line.size() > max_line_) {
    return refuse(id, proto::error_object("reply_too_long", "the reply has " + std::to_string(reply.line.size()) +
                                                                " bytes, over this connection's max_line of " +
                                                                std::to_string(max_line_) +
                                                                ": ask for less or say hello with a greater max_line"));
  }
  send(std::move(reply.line.append("\n")));
  if (reply.chunk) send(std::move(reply.chunk->append("\n")), Transport::Frame::chunk);
  answered(id);
}

void Session::refuse(const Json& id, const Json& error) {
  send(proto::fitted_error_line(id, error, max_line_) + "\n");
  answered(id);
}

void Session::answered(const Json& id) {
  --pending_;
  if (held_by_ == id) held_by_.reset();
  // Not from within the caller's loop over frames: a pipelined burst must not become a recursion.
  net::post(context_.io, [self = shared_from_this()] {
    self->pump_input();
    self->close_if_done();
  });
}

void Session::send_event(const proto::EventMessage& event) {
  std::string line = proto::event_line(to_json(event));
  if (line.size() > max_line_ || (event.data.is_null() && event.seq)) {
    proto::EventMessage brief = event;
    brief.data = nullptr;
    Json params = to_json(brief);
    params["more"] = true;
    line = proto::event_line(params);
  }
  ++context_.counters.events;
  send(line + "\n");
}

void Session::send(std::string frame, Transport::Frame kind) {
  if (closed_ || finishing_) return;
  if (queue_.empty()) last_step_ = Clock::now();
  queued_bytes_ += frame.size();
  queue_.push_back({std::move(frame), kind});
  if (queued_bytes_ > context_.config.reply_limit_bytes) return close("slow_reader: too many unsent bytes");
  if (queue_.size() == 1) write();
}

void Session::write() {
  const Outgoing& first = queue_.front();
  transport_->write(
      std::string_view(first.bytes).substr(sent_), first.kind,
      [self = shared_from_this()](const auto& error, std::size_t bytes) { self->on_write(error, bytes); });
}

void Session::on_write(const boost::system::error_code& error, std::size_t bytes) {
  if (closed_) return;
  if (error) return close("write failed");
  last_step_ = Clock::now();
  context_.counters.bytes_out += bytes;
  sent_ += bytes;
  queued_bytes_ -= bytes;
  if (sent_ == queue_.front().bytes.size()) {
    queue_.pop_front();
    sent_ = 0;
  }
  if (!queue_.empty()) {
    write();
  } else if (finishing_) {
    transport_->end_sending(shared_from_this());
    lingering_ = true;
    if (input_ended_) return close("finished");
    return read();
  }
  if (writable()) context_.requests.on_writable(*this);
  pump_input();
  close_if_done();
}

// --- end

void Session::finish() {
  finishing_ = true;
  if (queue_.empty()) close("finished");
}

void Session::close_if_done() {
  const bool done = input_ended_ && pending_ == 0 && queue_.empty() && subscriptions_.empty();
  if (done && !closed_) close("done");
}

void Session::close(const char* reason) {
  if (closed_) return;
  closed_ = true;
  spdlog::debug("conn={} closed: {}", peer_.number, reason);
  transport_->close();
  // Not from within a loop over subscriptions or waits.
  net::post(context_.io, [self = shared_from_this()] { self->context_.requests.on_closed(*self); });
}

void Session::check_deadlines(Clock::time_point now) {
  if (closed_) return;
  const Config& config = context_.config;
  if (!identity_ && !finishing_ && now - opened_ > config.hello_time) {
    return fail_connection(nullptr, "hello_required", "no hello came in time; the connection is closed");
  }
  if (input_ended_ && broken()) return close("the peer is gone");
  if (lingering_ && now - last_step_ > linger_time) return close("lingered too long");
  if (!queue_.empty() && now - last_step_ > config.stall) {
    spdlog::info("conn={} slow_reader: took no bytes", peer_.number);
    close("slow_reader");
  }
}

void answer(const Call& call, const Json& result) {
  call.session->answer(call.id, {proto::reply_line(call.id, result), std::nullopt});
}

}  // namespace sculpt::server
