#include "core/trajectory/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <istream>
#include <ostream>

#include "core/base/sha256.hpp"
#include "core/trajectory/binary_frame.hpp"
#include "core/trajectory/quantum.hpp"
#include "core/trajectory/trajectory_line.hpp"
#include "core/trajectory/trajectory_source.hpp"

namespace sculpt {
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
    bytes += static_cast<std::uint64_t>(line_end - top);
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
  std::uint64_t bytes = 0;
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

TrajectoryStart TrajectoryWriter::so_far() {
  impl_->hash_all();
  return {impl_->end.keyframes, impl_->bytes, impl_->hash.hex()};
}

TrajectoryEnd TrajectoryWriter::finish() {
  impl_->hash_all();
  impl_->end.sha256 = impl_->hash.hex();
  impl_->out << end_line(impl_->end) << '\n';
  return impl_->end;
}

struct TrajectoryReader::Impl {
  std::unique_ptr<TrajectorySource> source;
};

TrajectoryReader::TrajectoryReader(std::istream& in)
    : impl_(new Impl{in.peek() == binary_magic.front() ? open_binary(in) : open_text(in)}) {}

TrajectoryReader::~TrajectoryReader() = default;

const TrajectoryHeader& TrajectoryReader::header() const {
  return impl_->source->header();
}

std::uint64_t TrajectoryReader::line() const {
  return impl_->source->keyframes() + 1;  // the first line is the header
}

std::optional<Keyframe> TrajectoryReader::next() {
  return impl_->source->next();
}

}  // namespace sculpt
