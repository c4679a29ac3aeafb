// How many voxels a grid may have along each edge.
#pragma once

#include <bit>
#include <string>

#include "core/base/error.hpp"

namespace sculpt {

inline constexpr int min_resolution = 8, max_resolution = 1024;

/// A power of two, not too small or too large.
constexpr bool is_resolution(int n) {
  return n >= min_resolution && n <= max_resolution && std::has_single_bit(static_cast<unsigned>(n));
}

/// Throws InputError `resolution_invalid`.
inline void check_resolution(int n) {
  if (!is_resolution(n))
    throw InputError(
        "resolution_invalid",
        "resolution " + std::to_string(n) + " is not one of 8, 16, 32, 64, 128, 256, 512, 1024: choose one of these");
}

}  // namespace sculpt
