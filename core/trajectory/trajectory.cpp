#include "core/trajectory/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <istream>
#include <ostream>

#include "core/base/error.hpp"
#include "core/base/sha256.hpp"
#include "core/trajectory/quantum.hpp"
#include "core/trajectory/trajectory_line.hpp"

namespace sculpt {
namespace {

// No line of a trajectory comes near: 64 joints take 2 KiB. It bounds the memory that hostile input can take.
constexpr std::size_t longest_line = 1 << 20;

std::string line_name(std::uint64_t line) {
  return "trajectory line " + std::to_string(line);
}

[[noreturn]] void refuse(std::uint64_t line, const std::string& what) {
  throw InputError("trajectory_invalid", line_name(line) + ": " + what + "; fetch or plan the trajectory again");
}

}  // namespace

int run_length(const Keyframe& keyframe) {
  return keyframe.cut ? l1(keyframe.first, keyframe.last) + 1 : 0;
}

Configuration rounded(const Configuration& q) {
  // + 0.0 drops the sign of -0.
  return q.unaryExpr([](double value) { return std::nearbyint(value * quanta_per_unit) / quanta_per_unit + 0.0; });
}

Configuration rounded(const Configuration& q, const Configuration& lower, const Configuration& upper) {
  Configuration stored = rounded(q);
  for (Eigen::Index at = 0; at < q.size(); ++at)
    if (const int step = (stored[at] < lower[at]) - (stored[at] > upper[at]); step != 0)
      stored[at] = from_quanta(std::llround(stored[at] * quanta_per_unit) + step);
  return stored;
}

struct TrajectoryWriter::Impl {
  explicit Impl(std::ostream& stream) : out(stream), unhashed(1 << 16), top(unhashed.data()) {}

  // Room for one more line in `unhashed`.
  char* make_room(std::size_t size) {
    if (size > unhashed.size() - used()) hash_all();
    if (size > unhashed.size()) {
      unhashed.resize(size);
      top = unhashed.data();
    }
    return top;
  }

  // What was written from `top` to `line_end` goes out at once; it is hashed later, many lines in one go.
  void send(char* line_end) {
    out.write(top, line_end - top);
    top = line_end;
  }

  void hash_all() {
    hash.add({unhashed.data(), used()});
    top = unhashed.data();
  }

  std::size_t used() const { return static_cast<std::size_t>(top - unhashed.data()); }

  std::ostream& out;
  std::vector<char> unhashed;
  char* top;
  Sha256 hash;
  TrajectoryEnd end;
};

TrajectoryWriter::TrajectoryWriter(std::ostream& out, const TrajectoryHeader& header)
    : impl_(std::make_unique<Impl>(out)) {
  const std::string line = header_line(header) + '\n';
  impl_->send(std::copy(line.begin(), line.end(), impl_->make_room(line.size())));
}

TrajectoryWriter::~TrajectoryWriter() = default;

void TrajectoryWriter::add(const Keyframe& keyframe) {
  char* const line = impl_->make_room(longest_keyframe_line(static_cast<std::size_t>(keyframe.q.size())));
  impl_->send(write_keyframe_line(line, keyframe));
  ++impl_->end.keyframes;
  impl_->end.removed += static_cast<std::uint64_t>(run_length(keyframe));
}

TrajectoryEnd TrajectoryWriter::finish() {
  impl_->hash_all();
  impl_->end.sha256 = impl_->hash.hex();
  impl_->out << end_line(impl_->end) << '\n';
  return impl_->end;
}

struct TrajectoryReader::Impl {
  explicit Impl(std::istream& stream) : in(stream), buffer(longest_line) {}

  // The next line without its newline; empty optional at the end of the input.
  std::optional<std::string_view> read() {
    ++line;
    in.getline(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    const auto taken = static_cast<std::size_t>(in.gcount());
    if (in.eof() && taken == 0) return std::nullopt;
    if (in.bad()) refuse(line, "the file cannot be read");
    if (in.fail()) refuse(line, "longer than " + std::to_string(longest_line) + " bytes");
    return std::string_view(buffer.data(), in.eof() ? taken : taken - 1);
  }

  void absorb(std::string_view text) {
    hash.add(text);
    hash.add("\n");
  }

  void check_end(const TrajectoryEnd& end) {
    if (end.keyframes != keyframes)
      refuse(line, "the end line counts " + std::to_string(end.keyframes) + " keyframes, there are " +
                       std::to_string(keyframes));
    if (end.removed != removed)
      refuse(line, "the end line counts " + std::to_string(end.removed) + " removed voxels, there are " +
                       std::to_string(removed));
    if (end.sha256 != hash.hex()) refuse(line, "the hash does not match the lines before it");
    if (read()) refuse(line, "there is text after the end line");
  }

  std::istream& in;
  std::vector<char> buffer;
  std::uint64_t line = 0;
  std::uint64_t keyframes = 0, removed = 0;
  bool finished = false;
  Sha256 hash;
  TrajectoryHeader header;
};

TrajectoryReader::TrajectoryReader(std::istream& in) : impl_(std::make_unique<Impl>(in)) {
  const auto text = impl_->read();
  if (!text) refuse(1, "the file is empty");
  impl_->header = parse_header_line(*text, line_name(1));
  impl_->absorb(*text);
}

TrajectoryReader::~TrajectoryReader() = default;

const TrajectoryHeader& TrajectoryReader::header() const {
  return impl_->header;
}

std::uint64_t TrajectoryReader::line() const {
  return impl_->line;
}

std::optional<Keyframe> TrajectoryReader::next() {
  if (impl_->finished) return std::nullopt;
  const auto text = impl_->read();
  if (!text) refuse(impl_->line, "the end line is missing, the file is cut short");
  TrajectoryLine line = parse_line(*text, impl_->header, line_name(impl_->line));
  if (line.is_end) {
    impl_->check_end(line.end);
    impl_->finished = true;
    return std::nullopt;
  }
  impl_->absorb(*text);
  ++impl_->keyframes;
  impl_->removed += static_cast<std::uint64_t>(run_length(line.keyframe));
  return std::move(line.keyframe);
}

}  // namespace sculpt
