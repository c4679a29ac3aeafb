#include "core/trajectory/writer.hpp"

#include <algorithm>
#include <ostream>
#include <vector>

#include "core/base/sha256.hpp"
#include "core/trajectory/text/trajectory_line.hpp"

namespace sculpt {

struct TrajectoryWriter::Impl {
  Impl(std::ostream& stream, const TrajectoryHeader& of)
      : out(stream), header(of), line_bytes(max_keyframe_line_bytes(header)), unhashed(1 << 16), top(unhashed.data()) {}

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
  TrajectoryHeader header;
  std::size_t line_bytes;  ///< the longest
  std::vector<char> unhashed;
  char* top;
  Sha256 hash;
  std::uint64_t bytes = 0;
  TrajectoryEnd end;
};

TrajectoryWriter::TrajectoryWriter(std::ostream& out, const TrajectoryHeader& header)
    : impl_(std::make_unique<Impl>(out, header)) {
  const std::string line = header_line(header) + '\n';
  impl_->send(std::copy(line.begin(), line.end(), impl_->make_room(line.size())));
}

TrajectoryWriter::~TrajectoryWriter() = default;

void TrajectoryWriter::add(const Keyframe& keyframe) {
  char* const line = impl_->make_room(impl_->line_bytes);
  impl_->send(write_keyframe_line(line, keyframe, impl_->header));
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

}  // namespace sculpt
