#include "core/trajectory/segment.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "core/base/error.hpp"
#include "core/trajectory/number_text.hpp"
#include "core/trajectory/quantum.hpp"
#include "core/trajectory/trajectory_line.hpp"

namespace sculpt {
namespace {

constexpr int most_order = 3;
constexpr std::uint64_t token_move = 0, token_again = 1, first_cut_token = 2;
constexpr std::uint64_t directions = face_steps.size(), start_anywhere = 6, starts = 7;

std::uint64_t zigzag(std::int64_t value) {
  return static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63);
}

std::int64_t unzigzag(std::uint64_t value) {
  return static_cast<std::int64_t>(value >> 1 ^ (0 - (value & 1)));
}

int varint_bytes(std::uint64_t value) {
  return (std::bit_width(value | 1) + 6) / 7;
}

void append_varint(std::string& out, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) out += static_cast<char>(value | 0x80);
  out += static_cast<char>(value);
}

// Which of the `face_steps` it is, or `start_anywhere` if it is none.
std::uint64_t direction_of(Voxel step) {
  for (std::uint64_t at = 0; at < directions; ++at)
    if (face_steps[at] == step) return at;
  return start_anywhere;
}

// What the next cut is told relative to.
struct LastCut {
  Voxel end{0, 0, 0};
  std::uint64_t direction = 0;
  std::uint64_t length = 1;
};

void append_cut(std::string& out, const Keyframe& keyframe, LastCut& last) {
  LastCut cut{keyframe.last, last.direction, static_cast<std::uint64_t>(run_length(keyframe))};
  const Voxel gap = keyframe.first - last.end, run = keyframe.last - keyframe.first;
  const std::uint64_t start = direction_of(gap);
  const auto sign = [](int value) { return (value > 0) - (value < 0); };
  if (cut.length > 1)
    cut.direction = direction_of({sign(run.i), sign(run.j), sign(run.k)});
  else if (start != start_anywhere)
    cut.direction = start;  // of one voxel any direction is right: this one is what rows of such cuts repeat
  if (start == cut.direction && cut.direction == last.direction && cut.length == last.length) {
    append_varint(out, token_again);
  } else {
    append_varint(out, first_cut_token + start + starts * (cut.direction + directions * (cut.length - 1)));
    if (start == start_anywhere)
      for (int offset : {gap.i, gap.j, gap.k}) append_varint(out, zigzag(offset));
  }
  last = cut;
}

// Calls `visit(residual)` for the differences of the given order, with zeros before the first value.
template <typename Visit>
void visit_differences(std::span<const std::int64_t> values, int order, const Visit& visit) {
  std::array<std::int64_t, most_order> before{};
  for (std::int64_t value : values) {
    for (int level = 0; level < order; ++level) {
      const std::int64_t difference = value - before[static_cast<std::size_t>(level)];
      before[static_cast<std::size_t>(level)] = value;
      value = difference;
    }
    visit(value);
  }
}

// What a column takes by differences of each order.
std::array<std::size_t, most_order + 1> column_bytes(std::span<const std::int64_t> values) {
  std::array<std::size_t, most_order + 1> bytes{};
  std::array<std::int64_t, most_order + 1> before{};
  std::array<bool, most_order + 1> zeros{};
  for (std::int64_t value : values)
    for (std::size_t order = 0; order <= most_order; ++order) {
      const std::size_t start_of_zeros = zeros[order] ? 0 : 2;
      zeros[order] = value == 0;
      bytes[order] += value == 0 ? start_of_zeros : static_cast<std::size_t>(varint_bytes(zigzag(value)));
      const std::int64_t difference = value - before[order];
      before[order] = value;
      value = difference;
    }
  return bytes;
}

void append_column(std::string& out, std::span<const std::int64_t> values) {
  const auto bytes = column_bytes(values);
  const int best = static_cast<int>(std::min_element(bytes.begin(), bytes.end()) - bytes.begin());
  out += static_cast<char>(best);
  std::uint64_t zeros = 0;
  const auto end_zeros = [&] {
    if (zeros == 0) return;
    out += '\0';
    append_varint(out, zeros - 1);
    zeros = 0;
  };
  visit_differences(values, best, [&](std::int64_t residual) {
    if (residual == 0) {
      ++zeros;
      return;
    }
    end_zeros();
    append_varint(out, zigzag(residual));
  });
  end_zeros();
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
    if (order > most_order) refuse("a joint's order of differences is " + std::to_string(order));
    std::array<std::uint64_t, most_order> before{};  // unsigned: sums may wrap, what counts is checked
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
      if (quanta > most_quanta || quanta < -most_quanta) refuse("a joint value is out of range");
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

std::size_t longest_segment(std::size_t keyframes, std::size_t joints) {
  constexpr std::size_t longest_token = 3 + 3 * 2, longest_residual = 10;
  return keyframes * (longest_token + longest_residual * joints) + 2 * joints;
}

std::string encode_segment(std::span<const Keyframe> keyframes) {
  std::string body;
  LastCut last;
  for (const Keyframe& keyframe : keyframes) {
    if (keyframe.cut)
      append_cut(body, keyframe, last);
    else
      append_varint(body, token_move);
  }
  std::vector<std::int64_t> column(keyframes.size());
  const Eigen::Index joints = keyframes.empty() ? 0 : keyframes.front().q.size();
  for (Eigen::Index joint = 0; joint < joints; ++joint) {
    for (std::size_t at = 0; at < keyframes.size(); ++at) column[at] = quanta_of(keyframes[at].q[joint]);
    append_column(body, column);
  }
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
