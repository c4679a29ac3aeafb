#include "core/trajectory/reader.hpp"

#include <istream>

#include "core/trajectory/binary/binary_frame.hpp"
#include "core/trajectory/binary/binary_source.hpp"
#include "core/trajectory/text/text_source.hpp"

namespace sculpt {

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
