// How many voxels a grid may have along each edge.
#pragma once

#include <bit>

namespace sculpt {

inline constexpr int min_resolution = 8, max_resolution = 1024;

/// A power of two, not too small or too large.
constexpr bool is_resolution(int n) {
  return n >= min_resolution && n <= max_resolution && std::has_single_bit(static_cast<unsigned>(n));
}

}  // namespace sculpt
