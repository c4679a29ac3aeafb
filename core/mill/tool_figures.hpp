// What came of each tool of a plan.
#pragma once

#include <cstdint>
#include <string>

namespace sculpt {

/// Of one tool.
struct ToolFigures {
  std::string name;
  std::uint64_t removed = 0, keyframes = 0, runs = 0;
  double removed_m3 = 0, cut_m = 0, travel_m = 0;
  struct {
    double mean = 0, largest = 0;  ///< chip cross-section over depth times width, over a counted window
  } engagement;
};

}  // namespace sculpt
