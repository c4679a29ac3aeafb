#include "core/trajectory/binary/mill_token.hpp"

#include "core/trajectory/binary/varint.hpp"

namespace sculpt {
namespace {

enum : std::uint64_t { token_taken_along = 0, token_placed = 1, token_mill_cut = 2, token_change = 3, kinds = 4 };

}  // namespace

void append_mill_token(std::string& out, const Keyframe& keyframe, LastPlace& last) {
  const MillStep& step = *keyframe.mill;
  std::uint64_t token = keyframe.cut ? token_mill_cut : step.is_placed() ? token_placed : token_taken_along;
  if (step.is_change()) token = token_change;
  const bool turns = step.is_placed() && step.direction != last.direction;
  append_varint(out, token + kinds * (turns ? static_cast<std::uint64_t>(step.direction) + 1 : 0));
  if (keyframe.cut) append_varint(out, step.removed);
  if (step.is_change()) append_varint(out, static_cast<std::uint64_t>(step.tool));
  if (step.is_placed()) last = {step.direction, step.tip};
}

void read_mill_token(TokenReader& bytes, Keyframe& keyframe, const TrajectoryHeader& header, LastPlace& last) {
  const std::uint64_t token = bytes.varint(), kind = token % kinds, turned = token / kinds;
  MillStep& step = keyframe.mill.emplace();
  keyframe.cut = kind == token_mill_cut;
  if (turned > header.mill->directions.size()) bytes.refuse("a direction is not one of the header's");
  if (kind == token_placed || kind == token_mill_cut) {
    if (turned > 0) last.direction = static_cast<int>(turned) - 1;
    if (last.direction < 0) bytes.refuse("a place without a direction");
    step.direction = last.direction;
  } else if (turned > 0) {
    bytes.refuse("a direction without a place");
  }
  if (keyframe.cut) {
    const std::uint64_t removed = bytes.varint(), n = static_cast<std::uint64_t>(header.grid.n);
    if (removed > n * n * n) bytes.refuse("a cut removes more voxels than there are");
    step.removed = static_cast<std::uint32_t>(removed);
  }
  if (kind == token_change) {
    const std::uint64_t tool = bytes.varint();
    if (tool >= header.mill->tools.size()) bytes.refuse("a tool is not one of the header's");
    step.tool = static_cast<int>(tool);
  }
}

}  // namespace sculpt
