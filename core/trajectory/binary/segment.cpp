#include "core/trajectory/binary/segment.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "core/base/error.hpp"
#include "core/trajectory/binary/varint.hpp"
#include "core/trajectory/number_text.hpp"
#include "core/trajectory/quantum.hpp"
#include "core/trajectory/trajectory_line.hpp"

namespace sculpt {
namespace {

constexpr int max_order = 3;

template <typename Int>
std::vector<Int> differences(const std::vector<Int>& values) {
  std::vector<Int> steps(values);
  for (std::size_t at = 1; at < values.size(); ++at) steps[at] = values[at] - values[at - 1];
  return steps;
}

// What they take, a run of zeros two bytes.
template <typename Int>
std::size_t bytes_of(const std::vector<Int>& residuals) {
  const auto bytes_after = [](Int before, Int residual) -> Int {
    constexpr int bits = 8 * sizeof(Int);
    const Int size = residual ^ residual >> (bits - 1);
    Int bytes = 1;
#pragma GCC unroll 9
    for (int more = 6; more < bits - 1; more += 7) bytes += size >> more != 0;
    const Int zero = residual == 0, begins = before != 0;
    return bytes - zero + ((zero & begins) << 1);
  };
  Int bytes = bytes_after(1, residuals[0]);
  for (std::size_t at = 1; at < residuals.size(); ++at) bytes += bytes_after(residuals[at - 1], residuals[at]);
  return static_cast<std::size_t>(bytes);
}

template <typename Int>
void append_residuals(std::string& out, const std::vector<Int>& residuals) {
  const auto bytes = std::make_unique_for_overwrite<char[]>(max_varint_bytes * (residuals.size() + 1));
  char* end = bytes.get();
  std::uint64_t zeros = 0;
  const auto end_zeros = [&] {
    if (zeros == 0) return;
    *end++ = '\0';
    end = write_varint(end, zeros - 1);
    zeros = 0;
  };
  for (const Int residual : residuals) {
    if (residual == 0) {
      ++zeros;
      continue;
    }
    end_zeros();
    end = write_varint(end, zigzag(residual));
  }
  end_zeros();
  out.append(bytes.get(), end);
}

template <typename Int>
void append_by_differences(std::string& out, const std::vector<std::int64_t>& values) {
  std::array<std::vector<Int>, max_order + 1> residuals{std::vector<Int>(values.begin(), values.end())};
  std::size_t best = 0, least = bytes_of(residuals[0]);
  for (std::size_t order = 1; order <= max_order; ++order) {
    residuals[order] = differences(residuals[order - 1]);
    if (const std::size_t bytes = bytes_of(residuals[order]); bytes < least) {
      best = order;
      least = bytes;
    }
  }
  out += static_cast<char>(best);
  append_residuals(out, residuals[best]);
}

void append_column(std::string& out, const std::vector<std::int64_t>& values) {
  constexpr std::int64_t narrow = std::int64_t{1} << (31 - max_order);  // its differences fit into 32 bits
  const bool is_narrow = std::all_of(values.begin(), values.end(), [](auto v) { return v < narrow && v > -narrow; });
  is_narrow ? append_by_differences<std::int32_t>(out, values) : append_by_differences<std::int64_t>(out, values);
}

std::int64_t quanta_of(double value) {
  if (const auto quanta = to_quanta(value)) return *quanta;
  std::string text;
  append_number(text, value);
  throw InputError("trajectory_invalid", "joint value " + text +
                                             " is no multiple of 1e-7, which the binary form needs: keep the "
                                             "trajectory as .ndjson, or round it and verify it again");
}

class Decoder {
 public:
  Decoder(std::string_view body, const TrajectoryHeader& header, const std::string& where)
      : rest_(body), header_(header), where_(where) {}

  void read_tokens(std::vector<Keyframe>& keyframes) {
    for (Keyframe& keyframe : keyframes) read_token(keyframe);
  }

  void read_column(std::vector<Keyframe>& keyframes, Eigen::Index joint) {
    const int order = byte();
    if (order > max_order) refuse("a joint's order of differences is " + std::to_string(order));
    std::array<std::uint64_t, max_order> before{};  // unsigned: sums may wrap, what counts is checked
    std::uint64_t zeros = 0;
    for (Keyframe& keyframe : keyframes) {
      std::uint64_t value = 0;
      if (zeros > 0) {
        --zeros;
      } else {
        value = static_cast<std::uint64_t>(unzigzag(varint()));
        if (value == 0) zeros = varint();
      }
      for (int level = order; level-- > 0;) value = before[static_cast<std::size_t>(level)] += value;
      const auto quanta = static_cast<std::int64_t>(value);
      if (quanta > max_quanta || quanta < -max_quanta) refuse("a joint value is out of range");
      keyframe.q[joint] = from_quanta(quanta);
    }
    if (zeros > 0) refuse("a run of zeros is longer than the segment");
  }

  void end() const {
    if (!rest_.empty()) refuse("there is more than its keyframes need");
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError("trajectory_invalid", where_ + ": " + what + "; fetch or plan the trajectory again");
  }

  std::uint8_t byte() {
    if (rest_.empty()) refuse("the segment is too short for its keyframes");
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

  int offset() {
    const std::int64_t value = unzigzag(varint());
    if (value > header_.grid.n || value < -header_.grid.n)
      refuse("a voxel is outside the grid of " + std::to_string(header_.grid.n));
    return static_cast<int>(value);
  }

  void read_token(Keyframe& keyframe) {
    std::uint64_t token = varint();
    keyframe.cut = token != token_move;
    if (!keyframe.cut) return;
    std::uint64_t start = last_.direction;
    if (token != token_again) {
      token -= first_cut_token;
      start = token % starts;
      last_.direction = token / starts % directions;
      last_.length = token / starts / directions + 1;
      if (last_.length > static_cast<std::uint64_t>(header_.grid.n))
        refuse("a cut of " + std::to_string(last_.length) + " voxels is longer than the grid");
    }
    Voxel gap;
    if (start == start_anywhere)
      gap = {offset(), offset(), offset()};  // braces: in this order
    else
      gap = face_steps[start];
    keyframe.first = last_.end + gap;
    keyframe.last = keyframe.first + face_steps[last_.direction] * (static_cast<int>(last_.length) - 1);
    check_run(keyframe, header_.grid, where_);
    last_.end = keyframe.last;
  }

  std::string_view rest_;
  const TrajectoryHeader& header_;
  const std::string& where_;
  LastCut last_;
};

}  // namespace

std::size_t max_segment_bytes(std::size_t keyframes, std::size_t joints) {
  constexpr std::size_t max_token_bytes = 3 + 3 * 2, max_residual_bytes = 10;
  return keyframes * (max_token_bytes + max_residual_bytes * joints) + 2 * joints;
}

void SegmentEncoder::add(const Keyframe& keyframe) {
  append_token(tokens_, keyframe, last_);
  quanta_.reserve(max_segment_keyframes * static_cast<std::size_t>(keyframe.q.size()));
  for (const double value : keyframe.q) quanta_.push_back(quanta_of(value));
  ++keyframes_;
}

std::string SegmentEncoder::take() {
  std::string body = std::exchange(tokens_, {});
  const std::size_t joints = keyframes_ == 0 ? 0 : quanta_.size() / keyframes_;
  std::vector<std::int64_t> column(keyframes_);
  for (std::size_t joint = 0; joint < joints; ++joint) {
    for (std::size_t at = 0; at < keyframes_; ++at) column[at] = quanta_[at * joints + joint];
    append_column(body, column);
  }
  quanta_.clear();
  last_ = {};
  keyframes_ = 0;
  return body;
}

std::vector<Keyframe> decode_segment(std::string_view body, std::size_t count, const TrajectoryHeader& header,
                                     const std::string& where) {
  const auto joints = static_cast<Eigen::Index>(header.joints.size());
  std::vector<Keyframe> keyframes(count);
  for (Keyframe& keyframe : keyframes) keyframe.q.resize(joints);
  Decoder decoder(body, header, where);
  decoder.read_tokens(keyframes);
  for (Eigen::Index joint = 0; joint < joints; ++joint) decoder.read_column(keyframes, joint);
  decoder.end();
  return keyframes;
}

}  // namespace sculpt
