#include "core/trajectory/timeline.hpp"

#include <ostream>

#include "core/base/error.hpp"
#include "core/trajectory/binary/segment.hpp"
#include "core/trajectory/binary/token_reader.hpp"
#include "core/trajectory/binary/varint.hpp"
#include "core/trajectory/text/trajectory_line.hpp"

namespace sculpt {
namespace {

constexpr std::uint64_t labels = 3;
/// Of plans with milling tools: a move, a change to the tool that follows, a cut with the number of its runs on top.
constexpr std::uint64_t milled_move = 0, milled_change = 1, milled_cut = 2;
constexpr std::size_t voxels_a_word = 64;

// The label of the 64 voxels of a word of the sets, if all have the same.
bool is_uniform(std::uint64_t stock, std::uint64_t keep) {
  constexpr std::uint64_t all = ~std::uint64_t{0};
  return stock == 0 || (stock == all && (keep == 0 || keep == all));
}

Label label_of(std::uint64_t stock, std::uint64_t keep, std::size_t bit) {
  if ((stock >> bit & 1) == 0) return Label::air;
  return (keep >> bit & 1) != 0 ? Label::keep : Label::remove;
}

// Runs of equal labels, by the index of VoxelSet.
void append_runs(std::string& out, const VoxelGrid& voxels) {
  Label label = Label::air;
  std::uint64_t length = 0;
  const auto add = [&](Label next, std::uint64_t count) {
    if (next != label && length > 0) append_varint(out, labels * (length - 1) + static_cast<std::uint64_t>(label));
    length = next == label ? length + count : count;
    label = next;
  };
  for (std::size_t at = 0; at < voxels.stock.words().size(); ++at) {
    const std::uint64_t stock = voxels.stock.words()[at], keep = voxels.keep.words()[at];
    if (is_uniform(stock, keep)) {
      add(label_of(stock, keep, 0), voxels_a_word);
    } else {
      for (std::size_t bit = 0; bit < voxels_a_word; ++bit) add(label_of(stock, keep, bit), 1);
    }
  }
  append_varint(out, labels * (length - 1) + static_cast<std::uint64_t>(label));
}

void append_milled(std::string& out, const Keyframe& keyframe, const std::vector<MilledStock::Run>& runs,
                   LastCut& last) {
  if (keyframe.mill->is_change()) {
    append_varint(out, milled_change);
    append_varint(out, static_cast<std::uint64_t>(keyframe.mill->tool));
    return;
  }
  append_varint(out, keyframe.cut ? milled_cut + runs.size() : milled_move);
  for (const auto& [begin, end] : runs) append_token(out, {{}, true, begin, end}, last);
}

}  // namespace

TimelineWriter::TimelineWriter(std::ostream& out, const TrajectoryHeader& header, const VoxelGrid& voxels)
    : out_(out), unsent_(header_line(header) + '\n') {
  if (header.mill) milled_.emplace(header, voxels.stock);
  append_runs(unsent_, voxels);
  flush();
}

void TimelineWriter::add(const Keyframe& keyframe) {
  if (in_segment_ == max_segment_keyframes) {
    last_ = {};
    in_segment_ = 0;
  }
  if (milled_)
    append_milled(unsent_, keyframe, milled_->take(*keyframe.mill, keyframe.cut), last_);
  else
    append_token(unsent_, keyframe, last_);
  ++in_segment_;
}

void TimelineWriter::flush() {
  out_.write(unsent_.data(), static_cast<std::streamsize>(unsent_.size()));
  out_.flush();
  unsent_.clear();
}

struct TimelineReader::Impl {
  explicit Impl(std::string_view bytes)
      : line_end(bytes.find('\n')),
        header(parse_header_line(bytes.substr(0, line_end), where)),
        voxels{VoxelSet(header.grid.n), VoxelSet(header.grid.n)},
        tokens(line_end == bytes.npos ? std::string_view() : bytes.substr(line_end + 1), header, where) {
    read_runs();
  }

  void read_runs() {
    const auto n = static_cast<std::uint64_t>(header.grid.n), total = n * n * n;
    for (std::uint64_t filled = 0; filled < total;) {
      const std::uint64_t run = tokens.varint(), length = run / labels + 1;
      if (length > total - filled) tokens.refuse("its runs of voxels are longer than the grid");
      const auto label = static_cast<Label>(run % labels);
      for (const std::uint64_t end = filled + length; filled < end; ++filled) {
        const std::uint64_t bit = std::uint64_t{1} << filled % voxels_a_word, word = filled / voxels_a_word;
        if (label != Label::air) voxels.stock.words()[word] |= bit;
        if (label == Label::keep) voxels.keep.words()[word] |= bit;
      }
    }
  }

  TimelineStep read_step() {
    TimelineStep step;
    if (!header.mill) {
      if (const auto run = read_run()) step = {true, {*run}};
      return step;
    }
    const std::uint64_t token = tokens.varint();
    if (token == milled_change) {
      const std::uint64_t tool = tokens.varint();
      if (tool >= header.mill->tools.size()) tokens.refuse("it changes to a tool that its header does not have");
      step.tool = static_cast<int>(tool);
    }
    step.cut = token >= milled_cut;
    for (std::uint64_t left = step.cut ? token - milled_cut : 0; left > 0; --left) {
      const auto run = read_run();
      if (!run) tokens.refuse("a run of a cut is a move");
      step.runs.push_back(*run);
    }
    return step;
  }

  std::optional<std::pair<Voxel, Voxel>> read_run() {
    Keyframe keyframe;
    tokens.read_token(keyframe);
    return keyframe.cut ? std::optional(std::pair(keyframe.first, keyframe.last)) : std::nullopt;
  }

  static constexpr const char* where = "the timeline";
  std::size_t line_end;
  TrajectoryHeader header;
  VoxelGrid voxels;
  TokenReader tokens;
  std::size_t in_segment = 0;  ///< keyframes
};

TimelineReader::TimelineReader(std::string_view bytes) : impl_(std::make_unique<Impl>(bytes)) {}
TimelineReader::~TimelineReader() = default;

const TrajectoryHeader& TimelineReader::header() const {
  return impl_->header;
}

const VoxelGrid& TimelineReader::voxels() const {
  return impl_->voxels;
}

std::optional<TimelineStep> TimelineReader::next() {
  if (impl_->tokens.at_end()) return {};
  if (impl_->in_segment == max_segment_keyframes) {
    impl_->tokens.begin_segment();
    impl_->in_segment = 0;
  }
  try {
    TimelineStep step = impl_->read_step();
    ++impl_->in_segment;
    return step;
  } catch (const InputError&) {
    if (impl_->tokens.ran_out()) return {};
    throw;
  }
}

}  // namespace sculpt
