// A bound on how long an orderly end may take.
#pragma once

#include <chrono>
#include <thread>

namespace sculpt::server {

/// Unless it is destroyed before, ends the process with EX_TEMPFAIL (75) when the time is over. What was acknowledged
/// is on disk by then; jobs that still run are interrupted as by a kill.
class DrainLimit {
 public:
  explicit DrainLimit(std::chrono::milliseconds time);

 private:
  std::jthread timer_;
};

}  // namespace sculpt::server
