#include "core/trajectory/binary/segment.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "core/base/error.hpp"
#include "core/trajectory/binary/token_reader.hpp"
#include "core/trajectory/binary/varint.hpp"
#include "core/trajectory/quantum.hpp"
#include "core/trajectory/text/number_text.hpp"
#include "core/trajectory/text/trajectory_line.hpp"

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

/// Calls `set` with each keyframe and its value in quanta.
template <typename Set>
void read_column(TokenReader& bytes, std::vector<Keyframe>& keyframes, const Set& set) {
  const int order = bytes.byte();
  if (order > max_order) bytes.refuse("a joint's order of differences is " + std::to_string(order));
  std::array<std::uint64_t, max_order> before{};  // unsigned: sums may wrap, what counts is checked
  std::uint64_t zeros = 0;
  for (Keyframe& keyframe : keyframes) {
    std::uint64_t value = 0;
    if (zeros > 0) {
      --zeros;
    } else {
      value = static_cast<std::uint64_t>(unzigzag(bytes.varint()));
      if (value == 0) zeros = bytes.varint();
    }
    for (int level = order; level-- > 0;) value = before[static_cast<std::size_t>(level)] += value;
    const auto quanta = static_cast<std::int64_t>(value);
    if (quanta > max_quanta || quanta < -max_quanta) bytes.refuse("a joint value is out of range");
    set(keyframe, quanta);
  }
  if (zeros > 0) bytes.refuse("a run of zeros is longer than the segment");
}

}  // namespace

std::size_t columns_of(const TrajectoryHeader& header) {
  return header.joints.size() + (header.mill ? tip_columns : 0);
}

std::size_t max_segment_bytes(std::size_t keyframes, std::size_t columns) {
  constexpr std::size_t max_token_bytes = 3 + 3 * 2, max_residual_bytes = 10;
  return keyframes * (max_token_bytes + max_residual_bytes * columns) + 2 * columns;
}

void SegmentEncoder::add(const Keyframe& keyframe) {
  if (keyframe.mill)
    append_mill_token(tokens_, keyframe, last_place_);
  else
    append_token(tokens_, keyframe, last_);
  quanta_.reserve(max_segment_keyframes * (static_cast<std::size_t>(keyframe.q.size()) + tip_columns));
  for (const double value : keyframe.q) quanta_.push_back(quanta_of(value));
  if (keyframe.mill) quanta_.insert(quanta_.end(), last_place_.tip.begin(), last_place_.tip.end());
  ++keyframes_;
}

std::string SegmentEncoder::take() {
  std::string body = std::exchange(tokens_, {});
  const std::size_t columns = keyframes_ == 0 ? 0 : quanta_.size() / keyframes_;
  std::vector<std::int64_t> column(keyframes_);
  for (std::size_t number = 0; number < columns; ++number) {
    for (std::size_t at = 0; at < keyframes_; ++at) column[at] = quanta_[at * columns + number];
    append_column(body, column);
  }
  quanta_.clear();
  last_ = {};
  last_place_ = {};
  keyframes_ = 0;
  return body;
}

std::vector<Keyframe> decode_segment(std::string_view body, std::size_t count, const TrajectoryHeader& header,
                                     const std::string& where) {
  const auto joints = static_cast<Eigen::Index>(header.joints.size());
  std::vector<Keyframe> keyframes(count);
  for (Keyframe& keyframe : keyframes) keyframe.q.resize(joints);
  TokenReader bytes(body, header, where);
  LastPlace last;
  for (Keyframe& keyframe : keyframes) {
    if (header.mill)
      read_mill_token(bytes, keyframe, header, last);
    else
      bytes.read_token(keyframe);
  }
  for (Eigen::Index joint = 0; joint < joints; ++joint)
    read_column(bytes, keyframes,
                [joint](Keyframe& keyframe, std::int64_t quanta) { keyframe.q[joint] = from_quanta(quanta); });
  for (std::size_t axis = 0; header.mill && axis < tip_columns; ++axis)
    read_column(bytes, keyframes, [&](Keyframe& keyframe, std::int64_t quanta) {
      if (!keyframe.mill->is_placed()) return;
      if (std::abs(from_quanta(quanta)) > max_tip_m) bytes.refuse("a tip is out of range");
      keyframe.mill->tip[axis] = quanta;
    });
  if (!bytes.at_end()) bytes.refuse("there is more than its keyframes need");
  return keyframes;
}

}  // namespace sculpt
