// The last line of a trajectory file.
#pragma once

#include <cstdint>
#include <string>

namespace sculpt {

struct TrajectoryEnd {
  std::uint64_t keyframes = 0, removed = 0;
  std::string sha256;  ///< of every byte before the end line
};

}  // namespace sculpt
