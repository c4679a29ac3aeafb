// How many random cases a property test tries.
#pragma once

#include <algorithm>

namespace sculpt {

/// `full` of them in a program as users get it; a tenth under a sanitizer or without optimization, where each takes ten
/// to fifty times as long and a few find what those look for.
template <typename Number>
constexpr Number cases(Number full) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
  return std::max<Number>(1, full / 10);
#else
  return full;
#endif
}

}  // namespace sculpt
