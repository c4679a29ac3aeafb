#include "core/trajectory/binary/binary.hpp"

#include <algorithm>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <utility>

#include "core/base/sha256.hpp"
#include "core/trajectory/binary/binary_frame.hpp"
#include "core/trajectory/binary/segment.hpp"
#include "core/trajectory/text/trajectory_line.hpp"

namespace sculpt {
namespace {

constexpr std::size_t index_entry_bytes = 3 * 8, index_tail_bytes = 3 * 8 + 4;

// Refuses an index whose segments are not one after the other, as a writer leaves them.
void check_segments(const BinaryIn& in, const std::vector<FileSegment>& segments, std::uint64_t first_offset,
                    const FileSegment& end) {
  FileSegment expected{first_offset, 0, 0};
  for (std::size_t at = 0; at <= segments.size(); ++at) {
    const FileSegment& segment = at < segments.size() ? segments[at] : end;
    const std::uint64_t keyframes = segment.first_keyframe - expected.first_keyframe;
    const bool in_order = at == 0 ? segment.offset == first_offset && keyframes == 0 && segment.first_removed == 0
                                  : segment.offset > expected.offset && keyframes >= 1 &&
                                        keyframes <= max_segment_keyframes &&
                                        segment.first_removed >= expected.first_removed;
    if (!in_order) in.refuse("the index is not that of a trajectory");
    expected = segment;
  }
}

}  // namespace

struct BinaryWriter::Impl {
  Impl(std::ostream& stream, const Grid& cells) : out(stream), grid(cells) {}

  void send(const std::string& bytes) {
    hash.add(bytes);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    offset += bytes.size();
  }

  void end_segment() {
    if (pending.keyframes() == 0) return;
    segments.push_back({offset, keyframes, removed});
    const std::size_t count = pending.keyframes();
    const SegmentBytes segment{count, removed, pending.take()};
    send(segment.head());
    send(segment.body);
    keyframes += count;
    removed += std::exchange(pending_removed, 0);
  }

  std::ostream& out;
  Grid grid;
  std::uint64_t offset = 0, keyframes = 0, removed = 0;
  SegmentEncoder pending;
  std::uint64_t pending_removed = 0;
  std::vector<FileSegment> segments;
  Sha256 hash;
};

BinaryWriter::BinaryWriter(std::ostream& out, const TrajectoryHeader& header)
    : impl_(std::make_unique<Impl>(out, header.grid)) {
  impl_->send(preamble_bytes(header));
}

BinaryWriter::~BinaryWriter() = default;

void BinaryWriter::add(const Keyframe& keyframe) {
  if (keyframe.cut && !keyframe.mill && !is_run(keyframe, impl_->grid))
    check_run(keyframe, impl_->grid, "keyframe " + std::to_string(impl_->keyframes + impl_->pending.keyframes()));
  impl_->pending.add(keyframe);
  impl_->pending_removed += static_cast<std::uint64_t>(run_length(keyframe));
  if (impl_->pending.keyframes() == max_segment_keyframes) impl_->end_segment();
}

void BinaryWriter::finish() {
  impl_->end_segment();
  impl_->send(index_bytes(impl_->segments, impl_->keyframes, impl_->removed, impl_->offset));
  impl_->out << impl_->hash.hex();
}

BinaryFile::BinaryFile(std::istream& in) : in_(in) {
  BinaryIn start(in);
  std::string preamble;
  header_ = read_preamble(start, preamble);
  in.seekg(0, std::ios::end);
  const auto size = static_cast<std::uint64_t>(in.tellg());
  if (!in || size < preamble.size() + 5 + index_tail_bytes + sha256_hex_bytes) start.refuse("the file is cut short");

  const std::uint64_t tail_offset = size - sha256_hex_bytes - index_tail_bytes;
  in.seekg(static_cast<std::streamoff>(tail_offset));
  BinaryIn tail(in, tail_offset);
  const std::string end = tail.bytes(index_tail_bytes);
  keyframes_ = word_at<std::uint64_t>(end, 0);
  removed_ = word_at<std::uint64_t>(end, 8);
  const auto index_offset = word_at<std::uint64_t>(end, 16);
  if (index_offset < preamble.size() || index_offset > tail_offset - 5 ||
      (tail_offset - 5 - index_offset) % index_entry_bytes != 0)
    tail.refuse("the index is cut short");

  in.seekg(static_cast<std::streamoff>(index_offset));
  BinaryIn index(in, index_offset);
  const std::string entries = index.bytes(static_cast<std::size_t>(tail_offset - index_offset));
  for (std::size_t at = 5; at < entries.size(); at += index_entry_bytes)
    segments_.push_back({word_at<std::uint64_t>(entries, at), word_at<std::uint64_t>(entries, at + 8),
                         word_at<std::uint64_t>(entries, at + 16)});
  if (index_bytes(segments_, keyframes_, removed_, index_offset) != entries + end)
    index.refuse("the index's checksum is wrong");
  check_segments(index, segments_, preamble.size(), {index_offset, keyframes_, removed_});
}

std::vector<Keyframe> BinaryFile::read(std::size_t segment) const {
  const FileSegment& wanted = segments_.at(segment);
  const bool is_last = segment + 1 == segments_.size();
  const std::uint64_t next_keyframe = is_last ? keyframes_ : segments_[segment + 1].first_keyframe;
  const std::uint64_t next_removed = is_last ? removed_ : segments_[segment + 1].first_removed;
  in_.clear();
  in_.seekg(static_cast<std::streamoff>(wanted.offset));
  BinaryIn in(in_, wanted.offset);
  if (in.bytes(1)[0] != static_cast<char>(BinaryTag::segment)) in.refuse("no segment begins here");
  const SegmentBytes bytes = read_segment(in, columns_of(header_));
  if (bytes.keyframes != next_keyframe - wanted.first_keyframe || bytes.first_removed != wanted.first_removed)
    in.refuse("the segment is not the one of the index");
  std::vector<Keyframe> keyframes = decode_segment(bytes.body, bytes.keyframes, header_, in.where());
  std::uint64_t removed = bytes.first_removed;
  for (const Keyframe& keyframe : keyframes) removed += static_cast<std::uint64_t>(run_length(keyframe));
  if (removed != next_removed) in.refuse("the segment does not remove as many voxels as the index says");
  return keyframes;
}

std::size_t BinaryFile::segment_that_removes(std::uint64_t ordinal) const {
  if (ordinal >= removed_)
    throw std::out_of_range("voxel " + std::to_string(ordinal) + " of " + std::to_string(removed_) + " removed ones");
  const auto after =
      std::upper_bound(segments_.begin(), segments_.end(), ordinal,
                       [](std::uint64_t wanted, const FileSegment& segment) { return wanted < segment.first_removed; });
  return static_cast<std::size_t>(after - segments_.begin()) - 1;
}

}  // namespace sculpt
