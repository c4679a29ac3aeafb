// Bytes -> numbers and keyframes' tokens, checked. Internal to trajectory/.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/trajectory/binary/cut_token.hpp"
#include "core/trajectory/header.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// Reads what append_varint and append_token wrote; `bytes` and `header` must outlive it. Every function throws
/// InputError `trajectory_invalid` that begins with `where` for bytes that they cannot have written.
class TokenReader {
 public:
  TokenReader(std::string_view bytes, const TrajectoryHeader& header, std::string where)
      : rest_(bytes), header_(header), where_(std::move(where)) {}

  bool at_end() const { return rest_.empty(); }
  /// Was the last refusal for want of bytes?
  bool ran_out() const { return ran_out_; }

  std::uint8_t byte() {
    if (rest_.empty()) {
      ran_out_ = true;
      refuse("there are too few bytes for its keyframes");
    }
    const auto value = static_cast<std::uint8_t>(rest_.front());
    rest_.remove_prefix(1);
    return value;
  }

  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0;; shift += 7) {
      const std::uint64_t part = byte();
      if (shift == 63 && part > 1) refuse("a number has more than 64 bits");
      value |= (part & 0x7f) << shift;
      if (part < 0x80) return value;
    }
  }

  /// All of the keyframe but its joints.
  void read_token(Keyframe& keyframe);
  /// What follows is told as if there had been no cut yet.
  void begin_segment() { last_ = {}; }

  [[noreturn]] void refuse(const std::string& what) const;

 private:
  int offset();

  std::string_view rest_;
  const TrajectoryHeader& header_;
  std::string where_;
  LastCut last_;
  bool ran_out_ = false;
};

}  // namespace sculpt
