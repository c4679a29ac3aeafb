// Where bits flip along columns -> the bits.
#pragma once

#include <cstddef>

#include "core/base/large_pages.hpp"

namespace sculpt {

/// Each bit becomes the parity of itself and all bits before it in its column: columns step by `stride` bits and fill
/// `span` bits, both powers of two.
void prefix_parity(Words& words, std::size_t stride, std::size_t span);

}  // namespace sculpt
