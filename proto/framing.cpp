#include "proto/framing.hpp"

#include <algorithm>

namespace sculpt::proto {

void FrameReader::feed(std::string_view bytes) {
  if (!broken_) buffer_.append(bytes);
}

std::optional<WireFrame> FrameReader::next() {
  if (broken_) return std::nullopt;
  std::optional<WireFrame> frame = chunk_bytes_ ? next_chunk() : next_line();
  if (frame && (frame->kind == WireFrame::Kind::too_long || frame->kind == WireFrame::Kind::bad_chunk)) {
    broken_ = true;
    buffer_.clear();
    at_ = 0;
  }
  drop_taken();
  return frame;
}

std::optional<WireFrame> FrameReader::next_line() {
  while (true) {
    const std::size_t end = buffer_.find('\n', std::max(at_, searched_));
    searched_ = end == std::string::npos ? buffer_.size() : end;
    // One byte more than the limit may be a CR.
    if (searched_ - at_ > line_limit_ + 1) return WireFrame{WireFrame::Kind::too_long, {}};
    if (end == std::string::npos) return std::nullopt;
    std::string line = buffer_.substr(at_, end - at_);
    at_ = searched_ = end + 1;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.size() > line_limit_) return WireFrame{WireFrame::Kind::too_long, {}};
    if (!line.empty()) return WireFrame{WireFrame::Kind::line, std::move(line)};
  }
}

std::optional<WireFrame> FrameReader::next_chunk() {
  if (pending() < *chunk_bytes_ + 1) return std::nullopt;
  if (buffer_[at_ + *chunk_bytes_] != '\n') return WireFrame{WireFrame::Kind::bad_chunk, {}};
  WireFrame frame{WireFrame::Kind::chunk, buffer_.substr(at_, *chunk_bytes_)};
  at_ += *chunk_bytes_ + 1;
  searched_ = at_;
  chunk_bytes_.reset();
  return frame;
}

// Keeps the cost of many small frames in one buffer linear: moves the rest only when most of the buffer was taken.
void FrameReader::drop_taken() {
  if (at_ < buffer_.size() && at_ < buffer_.size() / 2) return;
  buffer_.erase(0, at_);
  searched_ = searched_ > at_ ? searched_ - at_ : 0;
  at_ = 0;
}

}  // namespace sculpt::proto
