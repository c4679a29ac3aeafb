// Where a segment of an .sct file begins.
#pragma once

#include <cstdint>

namespace sculpt {

/// Up to 4096 keyframes that can be decoded without those before them.
struct FileSegment {
  std::uint64_t offset = 0;  ///< bytes from the start of the file
  std::uint64_t first_keyframe = 0;
  std::uint64_t first_removed = 0;  ///< how many voxels the segments before it remove
};

}  // namespace sculpt
