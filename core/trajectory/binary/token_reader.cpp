#include "core/trajectory/binary/token_reader.hpp"

#include "core/base/error.hpp"
#include "core/trajectory/binary/varint.hpp"
#include "core/trajectory/text/trajectory_line.hpp"

namespace sculpt {

void TokenReader::refuse(const std::string& what) const {
  throw InputError("trajectory_invalid", where_ + ": " + what + "; fetch or plan the trajectory again");
}

int TokenReader::offset() {
  const std::int64_t value = unzigzag(varint());
  if (value > header_.grid.n || value < -header_.grid.n)
    refuse("a voxel is outside the grid of " + std::to_string(header_.grid.n));
  return static_cast<int>(value);
}

void TokenReader::read_token(Keyframe& keyframe) {
  std::uint64_t token = varint();
  keyframe.cut = token != token_move;
  if (!keyframe.cut) return;
  std::uint64_t start = last_.direction;
  if (token != token_again) {
    token -= first_cut_token;
    start = token % starts;
    last_.direction = token / starts % directions;
    last_.length = token / starts / directions + 1;
    if (last_.length > static_cast<std::uint64_t>(header_.grid.n))
      refuse("a cut of " + std::to_string(last_.length) + " voxels is longer than the grid");
  }
  Voxel gap;
  if (start == start_anywhere)
    gap = {offset(), offset(), offset()};  // braces: in this order
  else
    gap = face_steps[start];
  keyframe.first = last_.end + gap;
  keyframe.last = keyframe.first + face_steps[last_.direction] * (static_cast<int>(last_.length) - 1);
  check_run(keyframe, header_.grid, where_);
  last_.end = keyframe.last;
}

}  // namespace sculpt
