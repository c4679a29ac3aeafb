// Wall time since it was made, for reports: no decision of a planner may hang on it.
#pragma once

#include <chrono>

namespace sculpt {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace sculpt
