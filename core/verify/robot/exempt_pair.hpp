// Two links that the replay lets touch.
#pragma once

#include <string>

namespace sculpt {

/// Shapes of these links are not kept apart (others of theirs may be).
struct ExemptPair {
  std::string first, second;  ///< names of the links
  std::string why;
  auto operator<=>(const ExemptPair&) const = default;
};

}  // namespace sculpt
