#include "core/trajectory/binary/binary_source.hpp"

#include <istream>

#include "core/base/sha256.hpp"
#include "core/trajectory/binary/binary_frame.hpp"
#include "core/trajectory/binary/segment.hpp"

namespace sculpt {
namespace {

class BinarySource : public TrajectorySource {
 public:
  explicit BinarySource(std::istream& in) : in_(in) {
    std::string preamble;
    header_ = read_preamble(in_, preamble);
    hash_.add(preamble);
  }

  std::optional<Keyframe> next() override {
    if (at_ == segment_.size() && !finished_) read_part();
    if (finished_) return std::nullopt;
    count(segment_[at_]);
    return std::move(segment_[at_++]);
  }

 private:
  // The next segment, or the end of the file.
  void read_part() {
    const std::uint64_t offset = in_.offset();
    const auto tag = static_cast<BinaryTag>(in_.bytes(1)[0]);
    if (tag == BinaryTag::index) {
      check_end(offset);
      finished_ = true;
      return;
    }
    if (tag != BinaryTag::segment) in_.refuse("neither a segment nor the index begins here");
    const SegmentBytes bytes = read_segment(in_, columns_of(header_));
    if (bytes.first_removed != removed_)
      in_.refuse("the segment begins at removed voxel " + std::to_string(bytes.first_removed) + ", there were " +
                 std::to_string(removed_));
    segments_.push_back({offset, keyframes_, removed_});
    hash_.add(bytes.head());
    hash_.add(bytes.body);
    segment_ = decode_segment(bytes.body, bytes.keyframes, header_, in_.where());
    at_ = 0;
  }

  void check_end(std::uint64_t offset) {
    const std::string index = index_bytes(segments_, keyframes_, removed_, offset);
    if (in_.bytes(index.size() - 1) != index.substr(1)) in_.refuse("the index does not fit the segments");
    hash_.add(index);
    if (in_.bytes(sha256_hex_bytes) != hash_.hex()) in_.refuse("the hash does not match the bytes before it");
    if (!in_.at_end()) in_.refuse("there is more after the hash");
  }

  BinaryIn in_;
  Sha256 hash_;
  std::vector<FileSegment> segments_;  // read so far
  std::vector<Keyframe> segment_;      // the one at hand
  std::size_t at_ = 0;
};

}  // namespace

std::unique_ptr<TrajectorySource> open_binary(std::istream& in) {
  return std::make_unique<BinarySource>(in);
}

}  // namespace sculpt
