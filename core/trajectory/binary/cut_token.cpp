#include "core/trajectory/binary/cut_token.hpp"

#include "core/trajectory/binary/varint.hpp"

namespace sculpt {
namespace {

// Which of the `face_steps` it is, or `start_anywhere` if it is none.
std::uint64_t direction_of(Voxel step) {
  for (std::uint64_t at = 0; at < directions; ++at)
    if (face_steps[at] == step) return at;
  return start_anywhere;
}

void append_cut(std::string& out, const Keyframe& keyframe, LastCut& last) {
  LastCut cut{keyframe.last, last.direction, static_cast<std::uint64_t>(run_length(keyframe))};
  const Voxel gap = keyframe.first - last.end, run = keyframe.last - keyframe.first;
  const std::uint64_t start = direction_of(gap);
  if (cut.length > 1)
    cut.direction = direction_of(sign(run));
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

}  // namespace

void append_token(std::string& out, const Keyframe& keyframe, LastCut& last) {
  if (keyframe.cut)
    append_cut(out, keyframe, last);
  else
    append_varint(out, token_move);
}

}  // namespace sculpt
