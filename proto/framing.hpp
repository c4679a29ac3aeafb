// Bytes -> frames: lines, and counted chunks where a line announced one. A pure state machine: no sockets, no JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sculpt::proto {

inline constexpr std::size_t max_line_bytes = 1 << 20;  ///< without its end
inline constexpr std::size_t max_chunk_bytes = 4 << 20;

struct WireFrame {
  enum class Kind {
    line,      ///< `bytes` = the line without LF and CR; empty lines are skipped
    chunk,     ///< `bytes` = the announced raw bytes
    too_long,  ///< the line is over the limit: the stream cannot be used any more
    bad_chunk  ///< the chunk is not followed by LF: the stream cannot be used any more
  };
  Kind kind = Kind::line;
  std::string bytes;
};

/// Feed it bytes as they come, take frames out. After a line that announces a chunk call expect_chunk before the next
/// `next`.
class FrameReader {
 public:
  explicit FrameReader(std::size_t line_limit = max_line_bytes) : line_limit_(line_limit) {}

  void feed(std::string_view bytes);
  /// The next whole frame, or nothing until more bytes are fed. After too_long and bad_chunk there is never another.
  std::optional<WireFrame> next();
  std::size_t line_limit() const { return line_limit_; }
  /// For the lines from the next on.
  void set_line_limit(std::size_t bytes) { line_limit_ = bytes; }
  void expect_chunk(std::size_t bytes) { chunk_bytes_ = bytes; }
  /// Bytes fed and not yet taken: at most what was fed since the last `next` beyond one frame.
  std::size_t pending() const { return buffer_.size() - at_; }

 private:
  std::optional<WireFrame> next_line();
  std::optional<WireFrame> next_chunk();
  void drop_taken();

  std::size_t line_limit_;
  std::string buffer_;
  std::size_t at_ = 0;        // start of what is not yet taken
  std::size_t searched_ = 0;  // no LF between at_ and here
  std::optional<std::size_t> chunk_bytes_;
  bool broken_ = false;
};

}  // namespace sculpt::proto
