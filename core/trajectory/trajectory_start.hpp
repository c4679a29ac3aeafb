// How far a trajectory file was written.
#pragma once

#include <cstdint>
#include <string>

namespace sculpt {

/// The first lines of a trajectory file in the text form, header included.
struct TrajectoryStart {
  std::uint64_t keyframes = 0, bytes = 0;
  std::string sha256;  ///< of these bytes
  bool operator==(const TrajectoryStart&) const = default;
};

}  // namespace sculpt
