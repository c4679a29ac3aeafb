// What a program's part says, as it was read back.
#pragma once

#include <cstdint>
#include <vector>

namespace sculpt {

/// Values as the text has them: degrees and mm, rad and m in URScript; as the controller would hold them where it keeps
/// fewer digits.
struct ReadMove {
  std::vector<double> values;
  double seconds = 0;  ///< 0: the dialect says a speed
  double share = 0;    ///< of an axis's velocity; 0: it says a time
};

struct ReadPart {
  int tool = 0;  ///< number of the one that it has mounted before anything moves; 0: it does not stop for that
  std::uint64_t cut_before = 0, cut_after = 0;  ///< voxels that are removed before it, and with it
  std::vector<double> start;  ///< where it stops if an axis is more than 0.01 degree or mm from there, before it moves
  std::vector<ReadMove> moves;
  bool radians = false;  ///< values are rad and m
};

}  // namespace sculpt
