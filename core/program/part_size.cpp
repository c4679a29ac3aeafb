#include "core/program/part_size.hpp"

#include <algorithm>

namespace sculpt {
namespace {

// Moves of a writer before it is begun anew, so that its text stays short.
constexpr std::size_t moves_a_writer = 4096;
// What numbers can be longer than those that were measured: of an axis; of a part's count, lines and positions; and of
// a line and its position, which FANUC numbers, once there are more of them than a writer was given.
constexpr std::uint64_t longer_value = 16, longer_counts = 64, longer_numbers = 6;
constexpr std::size_t highest_part = 999'999;

}  // namespace

bool PartSize::fits(std::size_t begin, std::size_t returning, std::size_t count, std::size_t leaving) const {
  if (moves > 0 && returning + count + leaving > moves) return false;
  if (text.most == 0) return true;
  // One more: the first move of the path may have to say a speed that the one before it has said.
  const std::uint64_t retreats = (returning + leaving + 1) * text.retreat;
  return text.frame + retreats + text.until[begin + count] - text.until[begin] <= text.most;
}

std::size_t PartSize::moves_from(std::size_t begin, std::size_t returning, std::size_t most) const {
  std::size_t low = 0, high = most;
  while (low < high) {
    const std::size_t middle = low + (high - low + 1) / 2;
    if (fits(begin, returning, middle, 0))
      low = middle;
    else
      high = middle - 1;
  }
  return low;
}

TextMeter::TextMeter(Dialect dialect, const AxisLayout& layout, ProgramNames names, const Configuration& home)
    : dialect_(dialect), layout_(layout), names_(std::move(names)), home_(layout.to_axes(home)) {
  names_.part = names_.parts = highest_part;
  const std::uint64_t longer = longer_value * layout.axes.size() + longer_numbers;
  std::unique_ptr<PartWriter> sample = writer();
  const std::uint64_t before = sample->bytes();
  sample->add({home_, 1, 1});
  size_.retreat = sample->bytes() - before + longer;
  for (const ProgramFile& file : writer()->finish()) size_.frame += file.text.size();
  size_.frame += longer + longer_counts;
  size_.until.push_back(0);
}

std::unique_ptr<PartWriter> TextMeter::writer() const {
  return write_part(dialect_, layout_, names_, home_);
}

void TextMeter::add(const ProgramMove& move) {
  if (!writer_ || in_writer_ == moves_a_writer) {
    writer_ = writer();
    in_writer_ = 0;
  }
  ++in_writer_;
  const std::uint64_t before = writer_->bytes();
  writer_->add(move);
  size_.until.push_back(size_.until.back() + writer_->bytes() - before +
                        (dialect_ == Dialect::fanuc ? longer_numbers : 0));
}

TextSize TextMeter::take(std::uint64_t most) {
  writer_.reset();
  size_.most = most;
  return std::move(size_);
}

}  // namespace sculpt
