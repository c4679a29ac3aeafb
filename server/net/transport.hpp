// What a session speaks through: frames of the wire out, bytes of the wire in. I/O thread only.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "server/net/net.hpp"

namespace sculpt::server {

/// One read and one write at a time. A handler is never called from within the call that was given it, and keeps
/// alive whoever owns the transport.
class Transport {
 public:
  /// The bytes hold until the next read.
  using ReadHandler = std::function<void(const boost::system::error_code&, std::string_view bytes)>;
  using WriteHandler = std::function<void(const boost::system::error_code&, std::size_t bytes)>;
  enum class Frame { line, chunk };

  virtual ~Transport() = default;
  /// The next bytes, at most `limit`: lines and chunks, each ended by LF.
  virtual void read(std::size_t limit, ReadHandler handler) = 0;
  /// Writes some of the rest of a frame; its last byte is LF.
  virtual void write(std::string_view rest, Frame kind, WriteHandler handler) = 0;
  /// Tells the peer that nothing more comes; reading goes on. `owner` is kept until that is done.
  virtual void end_sending(std::shared_ptr<void> owner) = 0;
  virtual void close() = 0;
  virtual int native_handle() = 0;
};

}  // namespace sculpt::server
